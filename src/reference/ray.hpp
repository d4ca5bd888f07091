#pragma once

#include "reference/start.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

// Rays of the models with glass: the media that they are in, and their closest hit.
namespace packtrace::reference {

/// The glass bodies that a ray is inside of, by object number, the last entered on top; each at
/// most once. Where the stack is full, a body is not recorded, and its surface does not refract.
class GlassStack {
public:
    static constexpr int capacity = 8;
    static constexpr int outside = -1;

    /// The body whose glass the ray travels in, or `outside`.
    [[nodiscard]] int top() const
    {
        return depth_ > 0 ? bodies_[depth_ - 1] : outside;
    }
    [[nodiscard]] bool contains(int object) const
    {
        return std::find(bodies_.begin(), end(), object) != end();
    }
    [[nodiscard]] bool full() const
    {
        return depth_ == capacity;
    }
    void push(int object)
    {
        bodies_[depth_++] = object;
    }
    /// Removes a body from any place in the stack.
    void remove(int object)
    {
        depth_ = static_cast<std::size_t>(
            std::remove(bodies_.begin(), bodies_.begin() + static_cast<long>(depth_), object) -
            bodies_.begin());
    }

private:
    [[nodiscard]] std::array<int, capacity>::const_iterator end() const
    {
        return bodies_.begin() + static_cast<long>(depth_);
    }

    std::array<int, capacity> bodies_{};
    std::size_t depth_ = 0;
};

/// A ray of the models with glass.
template <class Real>
struct Ray {
    Vec3<Real> org;
    Vec3<Real> dir;  ///< unit
    GlassStack inside;
    Departure<Real> left = {};  ///< the surface that it leaves; none for a ray from the eye
};

/// The closest hit of a ray with all that shading needs.
template <class Real>
struct SurfacePoint {
    Real t;
    int object;
    Part part;
    Vec3<Real> P;
    Vec3<Real> outward;  ///< unit normal
    Vec3<Real> N;        ///< the same, turned against the ray
    bool leaving;        ///< the ray comes from the inside

    /// For a ray that leaves on the side from which this one comes.
    [[nodiscard]] Departure<Real> back() const
    {
        return {object, part, outward, leaving ? Side::inner : Side::outer};
    }
    /// For a ray that leaves on the other side.
    [[nodiscard]] Departure<Real> through() const
    {
        return back().towards(leaving ? Side::outer : Side::inner);
    }
};

/// The closest hit of a ray from `start` along `D`, up to t_max.
template <class Real>
[[nodiscard]] std::optional<SurfacePoint<Real>> closest_surface(const World<Real>& world,
                                                                const Start<Real>& start,
                                                                const Vec3<Real>& D, Real t_max)
{
    const Hit<Real> hit = closest_from(world.bodies, start, D, t_max);
    if (!hit)
        return std::nullopt;
    Vec3<Real> P = point_of(hit, start, D);
    if (world.self_hits == SelfHits::exact)
        P = on_surface(world.bodies, hit, P, length(start.org) + std::abs(hit.t) * length(D));
    Facing<Real> at = facing(world.bodies, hit, P, D);
    // The ray leaves a body where it entered it, as through a cone's apex.
    const bool at_once =
        hit.object == start.object && hit.leaving && hit.t <= std::numeric_limits<Real>::min();
    if (at_once && !at.leaving)
        at = {-at.outward, true};
    return SurfacePoint<Real>{hit.t, hit.object, hit.part, P, at.outward, at.turned(), at.leaving};
}

template <class Real>
[[nodiscard]] std::optional<SurfacePoint<Real>> closest_surface(const World<Real>& world,
                                                                const Ray<Real>& ray)
{
    return closest_surface(world, start_at(world, ray.left, ray.org), ray.dir, infinity<Real>);
}

/// The mirrored ray stays in the medium of `ray`.
template <class Real>
[[nodiscard]] Ray<Real> reflection_ray(const Ray<Real>& ray, const SurfacePoint<Real>& at)
{
    return {at.P, reflect_ray(-ray.dir, at.N), ray.inside, at.back()};
}

}  // namespace packtrace::reference
