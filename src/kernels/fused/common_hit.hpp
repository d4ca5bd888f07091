#pragma once

#include "kernels/fused/path.hpp"
#include "kernels/precision/refine.hpp"

// The closest hit of a packet of which all rays that hit anything hit the same object, by fewer
// operations than the search in lists takes: a few tests tell that nothing else is near, or that it
// lies behind the hit, which is refined at once. What they can't tell is left to that search. The
// bounds are those of the lists, and the places have the bits of refine.hpp.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Places of hits.
struct CommonHit {
    Vec3v<float> point;
    Vec3v<float> normal;  ///< outwards and unit
};

/// What a packet may hit first, by numbers in the plan; -1 for none.
struct Choice {
    bool is_known;  ///< false where find_any_hits() has to look
    std::uint32_t lanes;
    std::int8_t sphere, ground;
    std::int8_t behind;  ///< another sphere that has to be behind
};

/// Where rays start relative to a point, in double.
template <Generation G>
inline BothHalves<Vec3v<double>> starts_from(const RayPacket<float>& rays, const float (&eye)[3],
                                             const double (&base)[3])
{
    if constexpr (G == Generation::camera) {
        const double from[3] = {double{eye[0]} - base[0], double{eye[1]} - base[1],
                                double{eye[2]} - base[2]};
        return {broadcast(from), broadcast(from)};
    } else {
        const Vec3v<double> to = broadcast(base);
        return {widen_low(rays.org) - to, widen_high(rays.org) - to};
    }
}

template <Generation G>
inline BothHalves<Vec3v<double>> wide_origins(const RayPacket<float>& rays, const float (&eye)[3])
{
    if constexpr (G == Generation::camera) {
        const double from[3] = {double{eye[0]}, double{eye[1]}, double{eye[2]}};
        return {broadcast(from), broadcast(from)};
    } else {
        return widen(rays.org);
    }
}

/// The lanes in which Newton's step from `t` is enough, for rays that enter: is_enough() says so,
/// too, but not only there.
inline std::uint32_t is_surely_enough(const vreal<float>& t, const vreal<float>& bend,
                                      const vreal<float>& slope, const vreal<float>& dt,
                                      const vreal<float>& t_min)
{
    const vreal<float> size = abs(dt);
    const vreal<float> bent = bend * size;
    const vreal<float> steep = negated(slope);
    return bits((bent <= vreal<float>(0x1p-12f) * steep) &
                (bent * size <= vreal<float>(0x1p-31f) * (steep * t)) &
                (size <= vreal<float>(0x1p-10f) * t) &
                (t > vreal<float>(1.01f) * t_min));
}

/// The places `dt` behind t; `normal` is of them.
template <Generation G>
inline void set_place(CommonHit& hit, const RayPacket<float>& rays, const float (&eye)[3],
                      const BothHalves<Vec3v<double>>& dir, const BothHalves<vreal<double>>& t,
                      const vreal<float>& dt)
{
    const BothHalves<Vec3v<double>> org = wide_origins<G>(rays, eye);
    hit.point = narrow(madd<double>(t.low + widen_low(dt), dir.low, org.low),
                       madd<double>(t.high + widen_high(dt), dir.high, org.high));
}

/// Refines hits on a sphere from outside; `w` is from the rounded centre, `moment2` |w × d|².
/// Returns the lanes for which that was enough.
template <Generation G>
inline std::uint32_t refine_common(CommonHit& hit, vreal<float>& t_hit, const PlanSphere& sphere,
                                   const RayPacket<float>& rays, const float (&eye)[3])
{
    const Vec3v<float> w = rays.org - broadcast(sphere.center);
    const Vec3v<float> moment = cross(w, rays.dir);
    const vreal<float> across = rays.dir2 * vreal<float>(sphere.radius2);
    const vreal<float> root = sqrt(max(across - dot(moment, moment), vreal<float>(0.0f)));
    const vreal<float> b = dot(w, rays.dir);
    const vreal<float> inverse = vreal<float>(1.0f) / rays.dir2;
    const vreal<float> t = negated(b + root) * inverse;

    const BothHalves<Vec3v<double>> dir = widen(rays.dir);
    const BothHalves<vreal<double>> t_wide{widen_low(t), widen_high(t)};
    const BothHalves<Vec3v<double>> start = starts_from<G>(rays, eye, sphere.exact_center);
    const Vec3v<double> low = madd<double>(t_wide.low, dir.low, start.low);
    const Vec3v<double> high = madd<double>(t_wide.high, dir.high, start.high);
    const vreal<double> radius2(sphere.exact_radius2);
    const vreal<float> value = narrow(dot(low, low) - radius2, dot(high, high) - radius2);
    const vreal<float> slope = narrow(dot(low, dir.low), dot(high, dir.high));
    const Vec3v<float> gradient = narrow(low, high);
    const vreal<float> dt = vreal<float>(-0.5f) * value / slope;
    t_hit = t + dt;
    set_place<G>(hit, rays, eye, dir, t_wide, dt);
    hit.normal = scale<float>(vreal<float>(sphere.inverse_radius),
                              gradient + scale<float>(dt, rays.dir));
    return is_surely_enough(t, rays.dir2, slope, dt, rays.t_min);
}

/// The same for an anchored sphere.
template <Generation G>
inline std::uint32_t refine_common(CommonHit& hit, const PlanGround& ground,
                                   const RayPacket<float>& rays, const float (&eye)[3])
{
    const vreal<float> curvature(ground.curvature);
    const Vec3v<float> n = broadcast(ground.normal);
    const Vec3v<float> w = rays.org - broadcast(ground.base);
    const Vec3v<float> g = madd<float>(curvature, w, n);
    const vreal<float> at_start = dot(g + n, w) + vreal<float>(ground.offset);
    const vreal<float> bend = curvature * rays.dir2;
    const vreal<float> b = dot(g, rays.dir);
    const vreal<float> discriminant = msub(b, b, bend * at_start);
    const vmask<float> near = dot(g, g) <= vreal<float>(4.0f);
    const vreal<float> root = sqrt(max(discriminant, vreal<float>(0.0f)));
    const vreal<float> t = negated(at_start) / (b + with_sign_of(root, b));

    const BothHalves<Vec3v<double>> dir = widen(rays.dir);
    const BothHalves<vreal<double>> t_wide{widen_low(t), widen_high(t)};
    const BothHalves<Vec3v<double>> start = starts_from<G>(rays, eye, ground.exact_base);
    const Vec3v<double> low = madd<double>(t_wide.low, dir.low, start.low);
    const Vec3v<double> high = madd<double>(t_wide.high, dir.high, start.high);
    const vreal<double> exact_curvature(ground.exact_curvature);
    const vreal<double> offset(ground.exact_offset);
    const Vec3v<double> normal = broadcast(ground.exact_normal);
    const Vec3v<double> g_low = madd<double>(exact_curvature, low, normal);
    const Vec3v<double> g_high = madd<double>(exact_curvature, high, normal);
    const vreal<float> value =
        narrow(dot(g_low + normal, low) + offset, dot(g_high + normal, high) + offset);
    const vreal<float> slope = narrow(dot(g_low, dir.low), dot(g_high, dir.high));
    const Vec3v<float> gradient = narrow(g_low, g_high);
    const vreal<float> dt = vreal<float>(-0.5f) * value / slope;
    set_place<G>(hit, rays, eye, dir, t_wide, dt);
    hit.normal = madd<float>(curvature, scale<float>(dt, rays.dir), gradient);
    return is_surely_enough(t, bend, slope, dt, rays.t_min) & bits(near);
}

/// The lanes of a packet that may meet a sphere, and those that enter it for sure if nothing is
/// before.
struct MaybeLanes {
    std::uint32_t open;
    std::uint32_t sure;
    vreal<float> b;
};

inline MaybeLanes look_at(const PlanSphere& sphere, const RayPacket<float>& rays,
                          const vreal<float>& length, std::uint32_t active)
{
    const Vec3v<float> w = rays.org - broadcast(sphere.center);
    const vreal<float> moment2 = moment2_of(w, rays);
    const vreal<float> outer2(sphere.outer2);
    std::uint32_t near = active & ~bits(moment2 > outer2 * rays.dir2);
    if (near == 0)
        return {0, 0, moment2};
    const vreal<float> b = dot(w, rays.dir);
    const vreal<float> slack = vreal<float>(sphere.slack) * length;
    const std::uint32_t outside =
        bits(dot(w, w) > outer2 * vreal<float>(1.0f + roundoffs(16.0f)));
    near &= ~(outside & bits(b > slack));
    return {near,
            near & outside &
                bits((b < negated(slack)) &
                     (moment2 < vreal<float>(sphere.inner2) * rays.dir2)),
            b};
}

struct GroundLanes {
    std::uint32_t open;
    std::uint32_t sure;
};

inline GroundLanes look_at(const PlanGround& ground, const RayPacket<float>& rays,
                           const RayScale& scale, std::uint32_t active)
{
    GroundLanes lanes_of;
    const AnchoredLine line = line_of<false>(ground.filter, rays, scale);
    const std::uint32_t outside = bits(line.value > line.value_error);
    const std::uint32_t away = bits(line.b > line.slope_error);
    const std::uint32_t misses = bits(line.discriminant < negated(line.discriminant_error));
    lanes_of.open = active & ~(misses | (outside & away));
    lanes_of.sure =
        active & outside &
        bits((line.b < negated(line.slope_error)) &
             (line.discriminant > line.discriminant_error + line.discriminant_error));
    return lanes_of;
}

/// What rays of a generation may meet, by numbers in the plan.
struct Candidates {
    const std::uint8_t* spheres;
    const std::uint8_t* grounds;
    int sphere_count = 0;
    int ground_count = 0;
};

/// Whether another sphere is behind the hits for sure: they are outside, and the rays nearing it.
inline bool is_behind(const PlanSphere& sphere, const Vec3v<float>& point,
                      const RayPacket<float>& rays, std::uint32_t hits)
{
    const Vec3v<float> from = point - broadcast(sphere.center);
    return (hits & ~bits((dot(from, from) > vreal<float>(sphere.clear2)) &
                         (dot(from, rays.dir) < vreal<float>(0.0f)))) == 0;
}

/// Chooses what the rays of a packet hit, if anything. `own` is the surface that all start on, or -1
/// for none.
template <abi::Features F>
inline Choice choose_hit(const FramePlan<F>& plan, const Candidates& candidates,
                         const RayPacket<float>& rays, std::int32_t own, std::uint32_t active)
{
    constexpr Choice unknown{false, 0, -1, -1, -1};
    const RayScale scale(rays);
    int first = -1;
    int second = -1;
    std::uint32_t sure = 0;
    std::uint32_t open = 0;
    vreal<float> nearness = scale.length;
    for (int i = 0; i < candidates.sphere_count; ++i) {
        const int number = candidates.spheres[i];
        if (plan.spheres[number].surface == own)
            continue;
        const MaybeLanes maybe = look_at(plan.spheres[number], rays, scale.length, active);
        if (maybe.open == 0)
            continue;
        if (second >= 0)
            return unknown;
        if (first < 0 || (bits(maybe.b > nearness) & active) == active) {
            second = first;
            first = number;
            sure = maybe.sure;
            open = maybe.open;
            nearness = maybe.b;
        } else {
            second = number;
        }
    }
    int ground = -1;
    for (int i = 0; i < candidates.ground_count; ++i) {
        const int number = candidates.grounds[i];
        if (plan.grounds[number].surface == own)
            continue;
        const GroundLanes maybe = look_at(plan.grounds[number], rays, scale, active);
        if (maybe.open == 0)
            continue;
        if (ground >= 0)
            return unknown;
        ground = number;
        if (first < 0) {
            sure = maybe.sure;
            open = maybe.open;
        }
    }
    // With something else near, the sphere has to be what all rays hit.
    const bool others = first >= 0 && (second >= 0 || ground >= 0);
    if (sure != open || (others && sure != active))
        return unknown;
    return {true, sure, static_cast<std::int8_t>(first), static_cast<std::int8_t>(ground),
            static_cast<std::int8_t>(second)};
}

/// Refines what was chosen. False where that, or what comes first, can't be told.
template <Generation G, abi::Features F>
inline bool refine_choice(CommonHit& hit, const FusedTile<F>& tile, const Choice& choice,
                          const RayPacket<float>& rays)
{
    const FramePlan<F>& plan = tile.plan;
    const std::uint32_t lanes_of = choice.lanes;
    if (choice.sphere < 0)
        return (lanes_of & ~refine_common<G>(hit, plan.grounds[choice.ground], rays, tile.eye)) ==
               0;
    vreal<float> t;
    if ((lanes_of & ~refine_common<G>(hit, t, plan.spheres[choice.sphere], rays, tile.eye)) != 0)
        return false;
    if (choice.behind >= 0 &&
        ((far_lanes(plan, hit.point) & lanes_of) != 0 ||
         !is_behind(plan.spheres[choice.behind], hit.point, rays, lanes_of)))
        return false;
    if (choice.ground < 0)
        return true;
    const vreal<float> further = t * vreal<float>(1.0f + 0x1p-20f);
    const AnchoredLine line =
        line_of<false>(plan.grounds[choice.ground].filter, rays, RayScale(rays));
    return (lanes_of & ~bits(stays_above(line, further))) == 0;
}

template <abi::Features F>
inline std::int32_t surface_of(const FramePlan<F>& plan, const Choice& choice)
{
    return choice.sphere >= 0 ? plan.spheres[choice.sphere].surface
                              : plan.grounds[choice.ground].surface;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
