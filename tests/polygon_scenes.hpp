#pragma once

#include "reference/surfaces/hits.hpp"
#include <packtrace/scene.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace packtrace::test {

using Contours = std::vector<std::vector<Vec3>>;

[[nodiscard]] inline Object polygon(const Contours& contours)
{
    return {.surface = Polygon{contours}};
}

/// The six faces of |x|, |y|, |z| <= 1, each with an outward normal.
[[nodiscard]] inline std::vector<Object> cube_faces()
{
    std::vector<Object> faces;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            std::vector<Vec3> corners;
            for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                Vec3 corner;
                corner[axis] = side;
                corner[(axis + 1) % 3] = side > 0 ? u : v;
                corner[(axis + 2) % 3] = side > 0 ? v : u;
                corners.push_back(corner);
            }
            faces.push_back(polygon({corners}));
        }
    return faces;
}

/// A star with five points of radius 2 around the z axis, notches of radius 0.8, and a hole of 0.4.
[[nodiscard]] inline Object star()
{
    std::vector<Vec3> outline, hole;
    for (int i = 0; i < 10; ++i) {
        const double angle = 0.628318530717958647 * i;
        const Vec3 way(std::sin(angle), std::cos(angle), 0.0);
        outline.push_back((i % 2 == 0 ? 2.0 : 0.8) * way);
        if (i % 2 == 0)
            hole.push_back(0.4 * way);
    }
    return polygon({outline, hole});
}

[[nodiscard]] inline Scene polygon_scene(std::vector<Object> objects)
{
    return {.objects = std::move(objects)};
}

class PolygonRandom {
public:
    explicit PolygonRandom(unsigned seed) : engine_(seed)
    {
    }
    double between(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    std::size_t below(std::size_t end)
    {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(engine_);
    }
    Vec3 box(double half)
    {
        return {between(-half, half), between(-half, half), between(-half, half)};
    }

private:
    std::mt19937_64 engine_;
};

[[nodiscard]] inline Mat4 some_transform(PolygonRandom& random)
{
    Mat4 m = glm::translate(Mat4(1.0), random.box(5.0));
    m = glm::rotate(m, random.between(0.0, 6.0), glm::normalize(random.box(1.0) + Vec3(0, 0, 2)));
    m[0] += 0.4 * m[1];
    return glm::scale(m, Vec3(random.between(0.3, 3.0), -random.between(0.3, 3.0), 1.7));
}

template <class Real>
[[nodiscard]] std::vector<reference::SurfaceHit<Real>> reference_hits(
    const reference::Bodies<Real>& bodies, const Vec3& org, const Vec3& dir, Real least = 0)
{
    return reference::all_hits<Real>(bodies, reference::Vec3<Real>(org), reference::Vec3<Real>(dir),
                                     least, std::numeric_limits<Real>::infinity());
}

}  // namespace packtrace::test
