#pragma once

#include "reference/start.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

// Rays of the models that know glass: what they are inside of, and what they hit first.
namespace packtrace::reference {

/// The glass bodies a ray is inside, by object number, the last entered on top; each at most
/// once. A body that finds no room is left out, and its surface then bends nothing.
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
    /// Takes out a body, wherever in the stack it is.
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

/// A ray of the models that know glass.
template <class Real>
struct Ray {
    Vec3<Real> org;
    Vec3<Real> dir;  ///< unit
    GlassStack inside;
    Departure<Real> left = {};  ///< what it leaves; nothing for a ray from the eye
};

/// What a ray sees of the scene where it meets it first.
template <class Real>
struct SurfacePoint {
    Real t;
    int object;
    Part part;
    Vec3<Real> P;
    Vec3<Real> outward;  ///< unit normal
    Vec3<Real> N;        ///< the same, turned against the ray
    bool leaving;        ///< the ray comes from the inside

    /// Of a ray that goes back to where this one comes from.
    [[nodiscard]] Departure<Real> back() const
    {
        return {object, part, outward, leaving ? Side::inner : Side::outer};
    }
    /// Of a ray that goes on behind the surface.
    [[nodiscard]] Departure<Real> through() const
    {
        return back().towards(leaving ? Side::outer : Side::inner);
    }
};

/// What a ray from `start` along `D` meets first, up to t_max.
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
    // Out of a body at the very place where the ray went in, as through a cone's apex.
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

/// The mirrored ray stays in the glass it was in.
template <class Real>
[[nodiscard]] Ray<Real> reflection_ray(const Ray<Real>& ray, const SurfacePoint<Real>& at)
{
    return {at.P, reflect_ray(-ray.dir, at.N), ray.inside, at.back()};
}

}  // namespace packtrace::reference
