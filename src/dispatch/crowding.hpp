#pragma once

#include "kernel_abi/scene_view.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

// How many objects of a scene a line crosses.
namespace packtrace {

/// The bounding box and the discs of a set of balls.
struct BallCrowd {
    double low[3];
    double high[3];
    double discs = 0;  ///< sum of their areas

    BallCrowd()
    {
        std::fill_n(low, 3, std::numeric_limits<double>::infinity());
        std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
    }
    void add(const double (&center)[3], double radius)
    {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], center[axis] - radius);
            high[axis] = std::max(high[axis], center[axis] + radius);
        }
        discs += std::numbers::pi * radius * radius;
    }
    /// The mean number of balls that a line through the box crosses. The mean projected area of a
    /// convex body is a quarter of its surface (Cauchy). NaN without balls.
    [[nodiscard]] double crossed() const
    {
        const double x = high[0] - low[0];
        const double y = high[1] - low[1];
        const double z = high[2] - low[2];
        return discs / (0.5 * (x * y + y * z + z * x));
    }
};

/// An estimate of the number of spheres, and of balls around quadrics and polygons, that a line
/// crosses. It counts the objects in the scene's lists, not those in the bvh.
template <class Real>
[[nodiscard]] double crossed_by_a_line(const abi::GeometryView<Real>& scene)
{
    BallCrowd crowd;
    const auto& spheres = scene.spheres;
    for (int i = 0; i < spheres.count; ++i)
        crowd.add({spheres.center_x[i], spheres.center_y[i], spheres.center_z[i]},
                  spheres.radius[i]);
    const auto add_bounds = [&](const auto& list) {
        for (int i = 0; i < list.count; ++i) {
            const auto& bound = list.data[i].bound;
            crowd.add({bound[0], bound[1], bound[2]}, list.data[i].bound_radius);
        }
    };
    add_bounds(scene.quadrics);
    add_bounds(scene.polygons);
    return crowd.crossed();
}

}  // namespace packtrace
