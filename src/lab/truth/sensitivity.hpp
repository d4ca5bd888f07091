#pragma once

#include "lab/truth/wide_truth.hpp"

#include <cmath>

namespace packtrace::lab {

/// A coordinate in own space is a sum of three products, each rounded up to three times.
inline constexpr double own_roundings = 3.0;

/// How much the inputs of a ray change its values, for relative changes 1 of every input: sums of
/// magnitudes, for which double is enough. Inputs are the ray, the surface's place, its transform,
/// and the ray's start and way in own space.
class Sensitivity {
public:
    Sensitivity(const WideSurface& surface, const StressRay& ray)
        : by_points_(surface.by_points),
          org_(glm::abs(ray.org)),
          dir_(glm::abs(ray.dir)),
          from_offset_(sizes(wide(ray.org) - surface.offset)),
          place_(sizes(surface.place))
    {
        for (int row = 0; row < 3; ++row) {
            world_[row] = sizes(surface.world[row]);
            own_[row] = sizes(surface.own[row]);
        }
    }

    /// The change of the own covector g, whose world form is n, times the point at t.
    [[nodiscard]] double at(const Vec3& g, const Vec3& n, double t, const Vec3& own) const
    {
        const Vec3 way = std::abs(t) * dir_;
        double sum = dot3(n, org_ + way + place_);
        if (by_points_)
            sum += dot3(n, to_world(own)) + own_roundings * dot3(g, to_own(from_offset_ + way));
        return sum;
    }

    /// The change by rounding a general quadric's centre and the way to it, along the own covector
    /// whose world form is n.
    [[nodiscard]] double of_center(const Vec3& n, const Vec3& center) const
    {
        return own_roundings * dot3(n, to_world(center));
    }

    /// The change of the direction along g.
    [[nodiscard]] double of_direction(const Vec3& g, const Vec3& n, const Vec3& v) const
    {
        double sum = dot3(n, dir_);
        if (by_points_)
            sum += dot3(n, to_world(v)) + own_roundings * dot3(g, to_own(dir_));
        return sum;
    }

    /// The changes of the own direction's components.
    [[nodiscard]] Vec3 of_components(const Vec3& v) const
    {
        return to_own(dir_ + to_world(v)) + own_roundings * to_own(dir_);
    }

    /// The transposed inverse times a covector, in sums of magnitudes.
    [[nodiscard]] Vec3 covector(const Vec3& g) const
    {
        return by_points_ ? g.x * own_[0] + g.y * own_[1] + g.z * own_[2] : g;
    }

private:
    static double dot3(const Vec3& a, const Vec3& b)
    {
        return std::abs(a.x) * b.x + std::abs(a.y) * b.y + std::abs(a.z) * b.z;
    }
    [[nodiscard]] Vec3 to_world(const Vec3& v) const
    {
        return {dot3(v, world_[0]), dot3(v, world_[1]), dot3(v, world_[2])};
    }
    [[nodiscard]] Vec3 to_own(const Vec3& v) const
    {
        return {dot3(v, own_[0]), dot3(v, own_[1]), dot3(v, own_[2])};
    }

    bool by_points_;
    Vec3 org_;
    Vec3 dir_;
    Vec3 from_offset_;
    Vec3 place_;
    Vec3 world_[3];
    Vec3 own_[3];
};

}  // namespace packtrace::lab
