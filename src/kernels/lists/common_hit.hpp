#pragma once

#include "kernels/lists/common_objects.hpp"
#include "kernels/precision/refine.hpp"

// Closest hits of a packet whose rays all hit the same object or nothing, with fewer operations
// than the search in lists. A few tests show that no other object is near, or that it is behind the
// hit, which is refined at once. If they cannot, the packet goes through the lists. The error
// bounds are those of the lists, and hits have the same bits as in refine.hpp.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The hits of a packet, all on one surface.
struct CommonHit {
    vreal<float> t;
    Vec3v<float> point;
    Vec3v<float> outward;  ///< unit normal; not set with Refine::t
    std::int32_t surface;
    std::uint32_t lanes;  ///< 0 if nothing is hit
};

/// The rays' origins relative to the centre of a ball.
template <Origin O>
inline Vec3v<float> from_center(const CommonBall& ball, const RayPacket<float>& rays)
{
    if constexpr (O == Origin::shared)
        return broadcast(ball.from_center);
    else
        return rays.org - broadcast(ball.center);
}

/// The equation of a ground at the rays' origins.
template <Origin O>
inline AnchoredOrigin<float> form_at_start(const CommonGround& ground, const RayPacket<float>& rays)
{
    if constexpr (O == Origin::shared)
        return {broadcast(ground.shared_gradient), vreal<float>(ground.shared_value)};
    else
        return form_at(ground, rays.org);
}

/// The rays' origins relative to a point, in double.
template <Origin O>
inline BothHalves<Vec3v<double>> starts_from(const RayPacket<float>& rays,
                                             const float (&shared_origin)[3],
                                             const double (&base)[3])
{
    if constexpr (O == Origin::shared) {
        const double from[3] = {double{shared_origin[0]} - base[0],
                                double{shared_origin[1]} - base[1],
                                double{shared_origin[2]} - base[2]};
        return {broadcast(from), broadcast(from)};
    } else {
        const Vec3v<double> to = broadcast(base);
        return {widen_low(rays.org) - to, widen_high(rays.org) - to};
    }
}

template <Origin O>
inline BothHalves<Vec3v<double>> wide_origins(const RayPacket<float>& rays,
                                              const float (&shared_origin)[3])
{
    if constexpr (O == Origin::shared) {
        const double from[3] = {double{shared_origin[0]}, double{shared_origin[1]},
                                double{shared_origin[2]}};
        return {broadcast(from), broadcast(from)};
    } else {
        return widen(rays.org);
    }
}

/// A root in single precision, and what is known of the packet there.
struct RoughCommon {
    vreal<float> t;
    vreal<float> bend;
    std::uint32_t open;  ///< lanes that may hit the surface
    std::uint32_t sure;  ///< of these, the lanes that certainly enter it beyond 0
};

/// The rays of a packet that may hit a ball.
struct NearBall {
    vreal<float> moment2;
    vreal<float> b;
    std::uint32_t lanes;
    std::uint32_t outside;  ///< lanes that start outside
};

inline RoughCommon rough_common(const CommonSphere& sphere, const NearBall& near,
                                const RayPacket<float>& rays)
{
    const vreal<float> across = rays.dir2 * vreal<float>(sphere.radius2);
    const vreal<float> root = sqrt(max(across - near.moment2, vreal<float>(0.0f)));
    const vreal<float> inverse = vreal<float>(1.0f) / rays.dir2;
    const std::uint32_t sure =
        near.outside & bits((near.moment2 < vreal<float>(sphere.inner2) * rays.dir2) &
                            (near.b * abs(near.b) < vreal<float>(-sphere.slack2) * rays.dir2));
    return {negated(near.b + root) * inverse, rays.dir2, near.lanes, near.lanes & sure};
}

template <Origin O>
inline RoughCommon rough_common(const CommonGround& ground, const RayPacket<float>& rays,
                                std::uint32_t active)
{
    const auto [g, value] = form_at_start<O>(ground, rays);
    const vreal<float> b = dot(g, rays.dir);
    const vreal<float> side(ground.side);
    const vreal<float> slope2 = side * b * abs(b);
    const vreal<float> slope_error2 = vreal<float>(ground.slope_error2) * rays.dir2;
    RoughCommon rough;
    rough.bend = vreal<float>(ground.curvature) * rays.dir2;
    const std::uint32_t outside = bits(side * value > vreal<float>(ground.value_error));
    rough.open = active & ~(outside & bits(slope2 > slope_error2));
    if (rough.open == 0)
        return rough;
    const vreal<float> discriminant = msub(b, b, rough.bend * value);
    const vreal<float> error = vreal<float>(ground.discriminant_error) * rays.dir2;
    rough.open &= ~(outside & bits(discriminant < negated(error)));
    rough.sure = rough.open & outside &
                 bits((slope2 < negated(slope_error2)) & (discriminant > error + error) &
                      (dot(g, g) <= vreal<float>(4.0f)));
    const vreal<float> root = sqrt(max(discriminant, vreal<float>(0.0f)));
    rough.t = negated(value) / (b + with_sign_of(root, b));
    return rough;
}

/// Rays in double, and their points at a rough root, relative to `base`.
template <Origin O>
struct WidePlace {
    BothHalves<Vec3v<double>> dir;
    BothHalves<vreal<double>> t;
    BothHalves<Vec3v<double>> place;

    WidePlace(const RayPacket<float>& rays, const vreal<float>& rough,
              const float (&shared_origin)[3], const double (&base)[3])
        : dir(widen(rays.dir)), t{widen_low(rough), widen_high(rough)}
    {
        const BothHalves<Vec3v<double>> start = starts_from<O>(rays, shared_origin, base);
        place = {madd<double>(t.low, dir.low, start.low),
                 madd<double>(t.high, dir.high, start.high)};
    }
};

/// Moves hits by `dt` from a rough root. With Refine::t points are rounded a few times, which
/// is_behind() allows for.
template <Refine R, Origin O>
inline void move_from(CommonHit& hit, const WidePlace<O>& wide, const RoughCommon& rough,
                      const vreal<float>& dt, const RayPacket<float>& rays,
                      const float (&shared_origin)[3])
{
    hit.t = rough.t + dt;
    if constexpr (R == Refine::place) {
        const BothHalves<Vec3v<double>> org = wide_origins<O>(rays, shared_origin);
        hit.point = narrow(madd<double>(wide.t.low + widen_low(dt), wide.dir.low, org.low),
                           madd<double>(wide.t.high + widen_high(dt), wide.dir.high, org.high));
    } else {
        hit.point = madd<float>(hit.t, rays.dir, rays.org);
    }
}

/// Refines hits at a rough root. Returns the lanes for which one Newton step sufficed. With
/// Refine::t normals are not set.
template <Refine R, Origin O>
inline std::uint32_t refine_common(CommonHit& hit, const CommonSphere& sphere,
                                   const RoughCommon& rough, const RayPacket<float>& rays,
                                   const float (&shared_origin)[3])
{
    const WidePlace<O> wide(rays, rough.t, shared_origin, sphere.exact_center);
    const auto& [low, high] = wide.place;
    const vreal<double> radius2(sphere.exact_radius2);
    const vreal<float> value = narrow(dot(low, low) - radius2, dot(high, high) - radius2);
    const vreal<float> slope = narrow(dot(low, wide.dir.low), dot(high, wide.dir.high));
    const vreal<float> dt = vreal<float>(-0.5f) * value / slope;
    if constexpr (R == Refine::place)
        hit.outward = scale<float>(vreal<float>(sphere.inverse_radius),
                                   narrow(low, high) + scale<float>(dt, rays.dir));
    move_from<R>(hit, wide, rough, dt, rays, shared_origin);
    return is_surely_enough(rough.t, rays.dir2, slope, dt, rays.t_min);
}

/// The same for a ground.
template <Refine R, Origin O>
inline std::uint32_t refine_common(CommonHit& hit, const CommonGround& ground,
                                   const RoughCommon& rough, const RayPacket<float>& rays,
                                   const float (&shared_origin)[3])
{
    const WidePlace<O> wide(rays, rough.t, shared_origin, ground.exact_base);
    const auto& [low, high] = wide.place;
    const vreal<double> curvature(ground.exact_curvature);
    const vreal<double> offset(ground.exact_offset);
    const Vec3v<double> normal = broadcast(ground.exact_normal);
    const Vec3v<double> g_low = madd<double>(curvature, low, normal);
    const Vec3v<double> g_high = madd<double>(curvature, high, normal);
    const vreal<float> value =
        narrow(dot(g_low + normal, low) + offset, dot(g_high + normal, high) + offset);
    const vreal<float> slope = narrow(dot(g_low, wide.dir.low), dot(g_high, wide.dir.high));
    const vreal<float> dt = vreal<float>(-0.5f) * value / slope;
    if constexpr (R == Refine::place)
        hit.outward = madd<float>(vreal<float>(ground.curvature), scale<float>(dt, rays.dir),
                                  narrow(g_low, g_high));
    move_from<R>(hit, wide, rough, dt, rays, shared_origin);
    return is_surely_enough(rough.t, rough.bend, vreal<float>(ground.side) * slope, dt, rays.t_min);
}

/// The lanes of `active` that may hit a ball. The other results are set only if there are any.
template <Origin O>
inline NearBall near_ball(const CommonBall& ball, const RayPacket<float>& rays,
                          std::uint32_t active)
{
    const Vec3v<float> w = from_center<O>(ball, rays);
    const vreal<float> outer2(ball.outer2);
    NearBall near{moment2_of(w, rays), rays.dir2, 0, 0};
    const std::uint32_t not_past = active & ~bits(near.moment2 > outer2 * rays.dir2);
    if (not_past == 0)
        return near;
    near.b = dot(w, rays.dir);
    near.outside = bits(dot(w, w) > outer2 * vreal<float>(1.0f + roundoffs(16.0f)));
    near.lanes = not_past & ~(near.outside &
                              bits(near.b * abs(near.b) > vreal<float>(ball.slack2) * rays.dir2));
    return near;
}

/// Whether another sphere is certainly behind the hits: the hits are outside of it and the rays
/// approach it.
inline bool is_behind(const CommonObjects& common, const CommonSphere& sphere,
                      const Vec3v<float>& point, const RayPacket<float>& rays, std::uint32_t hits)
{
    const Vec3v<float> from = point - broadcast(sphere.center);
    return (hits &
            (far_lanes(common, point) | ~bits((dot(from, from) > vreal<float>(sphere.clear2)) &
                                              (dot(from, rays.dir) < vreal<float>(0.0f))))) == 0;
}

/// The same for a ground: rays and hits are in front of its top, or the rays run away from it, or
/// still approach it at the hit.
template <Origin O>
inline bool is_behind(const CommonObjects& common, const CommonGround& ground,
                      const Vec3v<float>& point, const vreal<float>& t,
                      const RayPacket<float>& rays, std::uint32_t hits)
{
    const Vec3v<float> top = broadcast(ground.top);
    const vreal<float> offset(ground.top_offset);
    std::uint32_t above = bits(dot(top, point) > offset) & ~far_lanes(common, point);
    if constexpr (O == Origin::shared)
        above = ground.origin_above ? above : 0;
    else
        above &= bits(dot(top, rays.org) > offset);
    if ((hits & ~above) == 0)
        return true;
    if (ground.curvature == 0.0f)
        return false;
    AnchoredFilter filter{};
    for (int axis = 0; axis < 3; ++axis) {
        filter.anchor[axis] = ground.base[axis];
        filter.normal[axis] = ground.normal[axis];
    }
    filter.curvature = ground.curvature;
    filter.offset = ground.offset;
    filter.slope_error = __builtin_sqrtf(ground.slope_error2) * inflation;
    filter.value_error = ground.value_error;
    const AnchoredLine line = line_of<Origin::any>(filter, rays, RayScale(rays));
    const vreal<float> further = t * vreal<float>(1.0f + 0x1p-20f);
    return (hits & ~above & ~bits(stays_above(line, further))) == 0;
}

/// find_common_sphere() if no sphere is near.
template <Refine R, Origin O>
inline bool find_common_ground(CommonHit& hit, const CommonObjects& common,
                               const CommonLists& candidates, const RayPacket<float>& rays,
                               const float (&shared_origin)[3], std::int32_t own,
                               std::uint32_t active)
{
    const CommonGround* first = nullptr;
    bool is_only = true;
    RoughCommon nearest;
    for (const CommonGround& ground : candidates.grounds) {
        if (ground.surface == own)
            continue;
        const RoughCommon rough = rough_common<O>(ground, rays, active);
        if (rough.open == 0)
            continue;
        is_only = first == nullptr;
        if (is_only || (bits(rough.t < nearest.t) & active) == active) {
            first = &ground;
            nearest = rough;
        }
    }
    if (first == nullptr)
        return true;
    if (nearest.sure != nearest.open || !(is_only || nearest.sure == active))
        return false;
    hit.lanes = nearest.open;
    hit.surface = first->surface;
    if ((hit.lanes & ~refine_common<R, O>(hit, *first, nearest, rays, shared_origin)) != 0)
        return false;
    if (is_only)
        return true;
    for (const CommonGround& ground : candidates.grounds)
        if (ground.surface != own && &ground != first &&
            !is_behind<O>(common, ground, hit.point, hit.t, rays, active))
            return false;
    return true;
}

/// Whether all grounds are certainly behind hits with a sphere, and the lanes that miss the sphere
/// miss the grounds too. `is_whole`: all lanes hit the sphere.
template <Origin O>
inline bool grounds_are_behind(const CommonHit& hit, const CommonObjects& common,
                               const CommonLists& candidates, const RayPacket<float>& rays,
                               std::int32_t own, std::uint32_t active, bool is_whole)
{
    for (const CommonGround& ground : candidates.grounds) {
        if (ground.surface == own ||
            is_behind<O>(common, ground, hit.point, hit.t, rays, hit.lanes)) {
            if (is_whole || ground.surface == own)
                continue;
            if (rough_common<O>(ground, rays, active & ~hit.lanes).open == 0)
                continue;
        }
        return false;
    }
    return true;
}

/// find_common_hit() among spheres and grounds.
template <Refine R, Origin O>
inline bool find_common_sphere(CommonHit& hit, const CommonObjects& common,
                               const CommonLists& candidates, const RayPacket<float>& rays,
                               const float (&shared_origin)[3], std::int32_t own,
                               std::uint32_t active)
{
    const CommonSphere* first = nullptr;
    const CommonSphere* second = nullptr;
    NearBall nearest{rays.dir2, rays.dir2, 0, 0};
    for (const CommonSphere& sphere : candidates.spheres) {
        if (sphere.body.first == own)
            continue;
        const NearBall near = near_ball<O>(sphere, rays, active);
        if (near.lanes == 0)
            continue;
        if (second != nullptr)
            return false;
        if (first == nullptr || (bits(near.b > nearest.b) & active) == active) {
            second = first;
            first = &sphere;
            nearest = near;
        } else {
            second = &sphere;
        }
    }
    if (first == nullptr)
        return find_common_ground<R, O>(hit, common, candidates, rays, shared_origin, own, active);
    const RoughCommon rough = rough_common(*first, nearest, rays);
    if (rough.sure != rough.open)
        return false;
    hit.lanes = rough.sure;
    hit.surface = first->body.first;
    if ((hit.lanes & ~refine_common<R, O>(hit, *first, rough, rays, shared_origin)) != 0)
        return false;
    // A second sphere has to be behind a hit that all rays have.
    const bool is_whole = hit.lanes == active;
    if (second != nullptr && !(is_whole && is_behind(common, *second, hit.point, rays, active)))
        return false;
    return grounds_are_behind<O>(hit, common, candidates, rays, own, active, is_whole);
}

/// Whether a packet misses all balls, except that of the object its rays start on.
template <Origin O>
inline bool passes_balls(const CommonLists& candidates, const RayPacket<float>& rays,
                         std::int32_t own, std::uint32_t active)
{
    for (const CommonBall& ball : candidates.balls)
        if (!is_on(ball.body, own) && near_ball<O>(ball, rays, active).lanes != 0)
            return false;
    return true;
}

/// Finds the hits of a packet if they are all on one surface. Returns false if that cannot be
/// decided; then `hit` is meaningless. Rays start among the origins of `common` (`shared_origin` is
/// their shared origin) and are certifiable(). `own` is the surface that all rays start on, whose
/// object they do not hit again; -1 for none.
template <Refine R, Origin O>
inline bool find_common_hit(CommonHit& hit, const CommonObjects& common,
                            const CommonLists& candidates, const RayPacket<float>& rays,
                            const float (&shared_origin)[3], std::int32_t own, std::uint32_t active)
{
    hit.lanes = 0;
    return passes_balls<O>(candidates, rays, own, active) &&
           find_common_sphere<R, O>(hit, common, candidates, rays, shared_origin, own, active);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
