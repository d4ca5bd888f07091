#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/observation.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/object_list.hpp"
#include "kernels/geometry/quadric_equation.hpp"

#include <limits>
#include <type_traits>

// Quadrics, clipped and capped: the test, also for rays from one point.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// An interval of a line, whose ends may be infinite.
template <class Real>
struct LineInterval {
    vreal<Real> low, high;
};

template <class Real>
inline LineInterval<Real> ordered(const vreal<Real>& a, const vreal<Real>& b)
{
    return {min(a, b), max(a, b)};
}

/// Where rays hit the clipping planes, and the interval between them. A ray parallel to the planes
/// is between them everywhere or nowhere.
template <class Real>
struct ClipCrossings {
    vreal<Real> low_t, high_t;
    LineInterval<Real> between;
};

template <class Real>
inline ClipCrossings<Real> clip_crossings(const abi::QuadricRecord<Real>& quadric,
                                          const vreal<Real>& height, const Vec3v<Real>& dir)
{
    const vreal<Real> climb = dot(broadcast(quadric.clip), dir);
    const vreal<Real> below = vreal<Real>(quadric.clip_low) - height;
    const vreal<Real> above = vreal<Real>(quadric.clip_high) - height;
    const vreal<Real> zero(Real(0));
    const vreal<Real> never(static_cast<Real>(__builtin_inf()));
    const auto along = climb == zero;
    const auto inside = (below <= zero) & (above >= zero);
    ClipCrossings<Real> clip;
    const vreal<Real> inverse = vreal<Real>(Real(1)) / climb;
    clip.low_t = select(along, negated(never), below * inverse);
    clip.high_t = select(along, never, above * inverse);
    clip.between = ordered<Real>(clip.low_t, clip.high_t);
    const auto nowhere = from_bits<Real>(bits(along) & ~bits(inside));
    clip.between.low = select(nowhere, never, clip.between.low);
    clip.between.high = select(nowhere, negated(never), clip.between.high);
    return clip;
}

/// The share of a t by which rounding may move a root past a clipping plane. Without it, a plane
/// that only touches a bowl would cut a hole into the bowl.
template <class Real>
inline constexpr Real clip_slack = Real(4) * std::numeric_limits<Real>::epsilon();
/// Upper bound of that share: a ray nearly parallel to a cylinder is closest to the centre
/// extremely far away.
template <class Real>
inline constexpr Real most_clip_slack = sizeof(Real) == sizeof(float) ? Real(0x1p-12)
                                                                      : Real(0x1p-20);

/// How far beyond the t of a clipping plane a root may lie and still count, if it was computed from
/// `start`.
template <class Real>
inline vreal<Real> slack_at_clip(const vreal<Real>& clip_t, const vreal<Real>& start)
{
    const vreal<Real> size = abs(clip_t);
    return min(vreal<Real>(clip_slack<Real>) * (size + abs(start)),
               vreal<Real>(most_clip_slack<Real>) * size);
}

/// An interval between clipping planes, widened by slack_at_clip().
template <class Real>
inline LineInterval<Real> with_slack(const LineInterval<Real>& between, const vreal<Real>& start)
{
    return {between.low - slack_at_clip<Real>(between.low, start),
            between.high + slack_at_clip<Real>(between.high, start)};
}

/// Lanes in which lines have roots with the unclipped side. A line through a cone's apex has its
/// root at the start itself (`at_start`); a line along a cylinder's axis has none.
template <class Real>
inline std::uint32_t lanes_with_roots(const Quadratic<Real>& side, const vmask<Real>& at_start)
{
    const vreal<Real> zero(Real(0));
    return bits(side.discriminant >= zero) & ~bits(at_start & (side.a == zero)) & all_lanes<Real>;
}

/// Lanes without roots whose lines are inside the unclipped side everywhere.
template <class Real>
inline std::uint32_t lanes_inside(const Quadratic<Real>& side, std::uint32_t crosses)
{
    const vreal<Real> zero(Real(0));
    return ~crosses & bits((side.a < zero) | ((side.a == zero) & (side.c < zero)));
}

/// Lanes in which the t of a cap lies between the two roots of the side. At the rim, a line that
/// `enters` by the cap leaves by the side, and the reverse.
template <class Real>
inline std::uint32_t lanes_within(const LineInterval<Real>& side, const vreal<Real>& t,
                                  std::uint32_t enters)
{
    return (enters & bits((t > side.low) & (t <= side.high))) |
           (~enters & bits((t >= side.low) & (t < side.high)));
}

/// Calls `visit(valid, t, piece)` for the hits of lines with the clipped and capped surface. Piece
/// 0 is the side, 1 the low cap and 2 the high cap. A t may be infinite, and a piece may be visited
/// twice for different lanes. Side and caps share one decision, the order of their t: at the rim a
/// line has exactly one hit, or two if it only touches the rim.
template <class Real, class Visit>
inline void visit_crossings(const abi::QuadricRecord<Real>& quadric,
                            const QuadricOrigin<Real>& origin, const RayPacket<Real>& rays,
                            const Visit& visit)
{
    const Vec3v<Real> v = apply_inverse(quadric, rays.dir);
    const auto [quadratic, start] = side_quadratic<Real>(quadric, origin.p, v, rays.dir);
    const vreal<Real> zero(Real(0));
    const vreal<Real> root = with_sign_of(sqrt(max(quadratic.discriminant, zero)), quadratic.b);
    const vreal<Real> minus_q = quadratic.b + root;
    const auto at_start = minus_q == zero;
    const std::uint32_t crosses = lanes_with_roots<Real>(quadratic, at_start);
    const std::uint32_t inside = quadric.capped ? lanes_inside<Real>(quadratic, crosses) : 0;
    if ((crosses | inside) == 0)
        return;
    const vreal<Real> first =
        start + select(at_start, zero, lesser_root(quadratic, root, minus_q, crosses));
    const vreal<Real> second = start + negated(minus_q) / quadratic.a;
    if (!quadric.clipped) {
        visit(from_bits<Real>(crosses), first, 0);
        visit(from_bits<Real>(crosses), second, 0);
        return;
    }
    const ClipCrossings<Real> clip = clip_crossings<Real>(quadric, origin.height, rays.dir);
    const LineInterval<Real> kept =
        quadric.capped ? clip.between : with_slack<Real>(clip.between, start);
    const auto between = [&](const vreal<Real>& t) { return (t >= kept.low) & (t <= kept.high); };
    const auto visit_side = [&] {
        visit(from_bits<Real>(crosses & bits(between(first))), first, 0);
        visit(from_bits<Real>(crosses & bits(between(second))), second, 0);
    };
    if (!quadric.capped)
        return visit_side();
    const LineInterval<Real> side = ordered<Real>(first, second);
    const std::uint32_t opens = bits(quadratic.a < zero);
    const std::uint32_t climbs = bits(clip.low_t <= clip.high_t);
    // A line enters by one cap and leaves by the other. A line that only touches the rim has two
    // hits there: it enters by one piece and leaves by the other, and visits keep this order.
    const std::uint32_t enters[2] = {climbs, ~climbs};
    const vreal<Real> cap_t[2] = {clip.low_t, clip.high_t};
    const auto visit_cap = [&](int cap, std::uint32_t lanes_of) {
        const vreal<Real>& t = cap_t[cap];
        const std::uint32_t hits =
            lanes_of & ((crosses & (opens ^ lanes_within<Real>(side, t, enters[cap]))) | inside);
        if (hits != 0)
            visit(from_bits<Real>(hits), t, cap + 1);
    };
    for (int cap = 0; cap < 2; ++cap)
        visit_cap(cap, enters[cap]);
    visit_side();
    for (int cap = 0; cap < 2; ++cap)
        visit_cap(cap, ~enters[cap]);
}

/// A quadric for rays that share their origin.
template <class Real>
struct SharedOriginQuadric {
    const abi::QuadricRecord<Real>* record;
    Real p[3];
    Real height;
};

template <class Real>
inline SharedOriginQuadric<Real> share_origin(const abi::QuadricRecord<Real>& quadric,
                                              const Vec3v<Real>& org)
{
    const QuadricOrigin<Real> at = quadric_origin<Real>(quadric, org);
    return {&quadric,
            {first_lane<Real>(at.p.x), first_lane<Real>(at.p.y), first_lane<Real>(at.p.z)},
            first_lane<Real>(at.height)};
}

template <class Real, class Visit>
inline void visit_crossings(const abi::QuadricRecord<Real>& quadric, const RayPacket<Real>& rays,
                            const Visit& visit)
{
    visit_crossings(quadric, quadric_origin<Real>(quadric, rays.org), rays, visit);
}

template <class Real, class Visit>
inline void visit_crossings(const SharedOriginQuadric<Real>& quadric, const RayPacket<Real>& rays,
                            const Visit& visit)
{
    const QuadricOrigin<Real> origin{broadcast(quadric.p), vreal<Real>(quadric.height)};
    visit_crossings(*quadric.record, origin, rays, visit);
}

/// The number of surfaces of a quadric: its side, and two caps if it is capped.
template <class Real>
inline int pieces_of(const abi::QuadricRecord<Real>& quadric)
{
    return quadric.capped ? 3 : 1;
}

template <class Real>
inline Body body_of(const abi::QuadricRecord<Real>& quadric)
{
    return {quadric.surface, pieces_of(quadric)};
}
template <class Real>
inline Body body_of(const SharedOriginQuadric<Real>& quadric)
{
    return body_of(*quadric.record);
}

template <class Real>
inline const abi::QuadricRecord<Real>& record_of(const abi::QuadricRecord<Real>& quadric)
{
    return quadric;
}
template <class Real>
inline const abi::QuadricRecord<Real>& record_of(const SharedOriginQuadric<Real>& quadric)
{
    return *quadric.record;
}

/// The rounding error of the square of a moment, as a share, with a margin of a factor of a
/// thousand.
template <class Real>
inline constexpr Real moment2_slack = sizeof(Real) == sizeof(float) ? Real(2e-10) : Real(2e-27);

/// The lanes whose lines pass close to the ball around a quadric. The other lanes need no test of
/// their own, which is expensive.
template <class Real>
inline std::uint32_t near_ball(const abi::QuadricRecord<Real>& quadric, const RayPacket<Real>& rays)
{
    const Real radius = quadric.bound_radius;
    if (!(radius < static_cast<Real>(__builtin_inf())))
        return all_lanes<Real>;
    const Vec3v<Real> w = rays.org - broadcast(quadric.bound);
    const Vec3v<Real> moment = cross(w, rays.dir);
    const vreal<Real> outer2 = madd(vreal<Real>(moment2_slack<Real>), dot(w, w),
                                    vreal<Real>(Real(1.001) * radius * radius));
    // With NaN the comparison fails and the lane is kept.
    return ~bits(dot(moment, moment) > outer2 * rays.dir2) & all_lanes<Real>;
}

template <class Object, class Real>
concept IsQuadric = std::is_same_v<Object, abi::QuadricRecord<Real>> ||
    std::is_same_v<Object, SharedOriginQuadric<Real>>;

/// Keeps closer hits, except in lanes that start on the quadric.
template <class Object, class Real, class Own>
requires IsQuadric<Object, Real>
inline void keep_closest(HitPacket<Real>& hit, const Object& quadric, const RayPacket<Real>& rays,
                         const Own& own)
{
    const Body body = body_of(quadric);
    const std::uint32_t others = near_ball(record_of(quadric), rays) &
                                 own.template lanes_on_others<Real>(body.first, body.pieces);
    if (others == 0)
        return;
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        std::uint32_t counts = others & bits(valid & (t > rays.t_min));
        // A ray that touches the rim enters by the cap if the cap was visited first.
        const std::uint32_t ties = piece == 0 ? counts & bits(t == hit.t) : 0;
        if (ties != 0)
            counts &= ~(ties & lanes_on_body<Real>(hit.surface, body.first + 1, body.pieces - 1));
        keep_closer<Real>(hit, from_bits<Real>(counts), t, body.first + piece);
    });
}
/// Lanes that any piece occludes.
template <class Object, class Real>
requires IsQuadric<Object, Real>
inline std::uint32_t occluding_lanes(const RayEnd<Real>& end, const Object& quadric,
                                     const RayPacket<Real>& rays)
{
    const std::uint32_t near = near_ball(record_of(quadric), rays);
    std::uint32_t blocked = 0;
    if (near == 0)
        return blocked;
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int) {
        blocked |= bits(valid & end.blocked_at(t, rays));
    });
    return blocked & near;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
