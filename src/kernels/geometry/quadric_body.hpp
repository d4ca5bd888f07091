#pragma once

#include "kernels/geometry/quadric_place.hpp"

// Where rays that start on one piece of a quadric hit that quadric again, in double. The start is
// known to be on the piece, whatever rounding did to the point: the side has a root at 0 along the
// ray, the start is between the clipping planes, and on a cap it is inside the side. So every ray
// that enters a capped quadric leaves it, however close to a rim it starts; a ray that leaves it
// where it starts does so at the smallest number above 0.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The hits ahead in their order: at most two with the side, then one with a cap.
struct CrossingsAhead {
    vreal<double> side[2];
    vreal<double> cap;
    std::uint32_t meets_side[2];
    std::uint32_t meets_cap;
    std::uint32_t cap_is_high;
};

/// The first of these hits beyond t_min.
inline OwnCrossing first_of(const CrossingsAhead& ahead, const vreal<double>& t_min)
{
    const vreal<double> never(__builtin_inf());
    const auto counts = [&](const vreal<double>& t, std::uint32_t meets) {
        return meets & bits(t > t_min) & bits(t < never);
    };
    const vreal<double> cap_t = max(ahead.cap, at_once());
    const std::uint32_t by_cap = counts(cap_t, ahead.meets_cap);
    OwnCrossing first{select(from_bits<double>(by_cap), cap_t, never), by_cap & ~ahead.cap_is_high,
                      by_cap & ahead.cap_is_high};
    for (int i = 1; i >= 0; --i) {
        const vreal<double> side_t = max(ahead.side[i], at_once());
        const std::uint32_t by_side = counts(side_t, ahead.meets_side[i]);
        first.t = select(from_bits<double>(by_side), side_t, first.t);
        first.low_cap &= ~by_side;
        first.high_cap &= ~by_side;
    }
    return first;
}

/// A gradient that is longer by this factor is much steeper.
inline constexpr double much_steeper = 4.0;

/// If the first Newton step reduces the distance to at most this share, as many further steps
/// reduce it below the resolution of double.
inline constexpr double nearer_by_step = 0x1p-4;
inline constexpr int further_steps = 3;

/// Where rays start, and the lanes in which that point is on the side up to the rounding of double.
struct SideStart {
    Vec3v<double> p;
    std::uint32_t on_side = 0;
};

/// The point of the side closest to `p`, if p is close to the side; p itself if it is not, measured
/// by the size of the quadric.
inline SideStart next_on_side(const abi::QuadricRecord<double>& quadric, const Vec3v<double>& p,
                              vmask<double> wanted)
{
    const auto step_from = [&](const Vec3v<double>& at) {
        const Vec3v<double> gradient = side_gradient<double>(quadric, at);
        const vreal<double> half = vreal<double>(-0.5) * quadric_value<double>(quadric, at);
        const vreal<double> step = half / dot(gradient, gradient);
        return madd<double>(step, apply_inverse(quadric, gradient), at);
    };
    const vreal<double> off = abs(quadric_value<double>(quadric, p));
    Vec3v<double> next = step_from(p);
    const auto nearer = abs(quadric_value<double>(quadric, next)) <=
                        max(vreal<double>(nearer_by_step) * off,
                            vreal<double>(residual_slack) * value_size<double>(quadric, p));
    for (int i = 0; i < further_steps; ++i)
        next = step_from(next);
    const auto moves = wanted & nearer;
    return {select(moves, next, p), bits(moves)};
}

/// Where on the side rays start whose rounded start is `p`. As a rule this is p itself, treated as
/// on the side. The equation has the same value at the rays' other root, `far_t` away, and the
/// flatter it is there, the further that point is off the side. Where it is much flatter, as next
/// to a cone's apex, rays start from the point of the side closest to p.
inline SideStart start_on_side(const abi::QuadricRecord<double>& quadric, const Vec3v<double>& p,
                               const Vec3v<double>& v, const vreal<double>& far_t)
{
    // The gradient of two planes is not that of one equation, and is as steep everywhere.
    if (crossing_planes(quadric))
        return {p};
    const Vec3v<double> here = side_gradient<double>(quadric, p);
    const Vec3v<double> there = side_gradient<double>(quadric, madd<double>(far_t, v, p));
    const auto flatter =
        vreal<double>(much_steeper * much_steeper) * dot(there, there) < dot(here, here);
    return none(flatter) ? SideStart{p} : next_on_side(quadric, p, flatter);
}

/// How far rounding of the start may move the side's `root` past a clipping plane. It is measured
/// by the value of the equation at the start, which is 0 up to rounding. Without it, a plane that
/// only touches a bowl would cut a hole into the bowl. With caps it is 0: there the order of side
/// and caps decides.
inline vreal<double> place_error(const abi::QuadricRecord<double>& quadric, const SideStart& start,
                                 const SurfaceLine& line, const vreal<double>& root)
{
    if (quadric.capped)
        return vreal<double>(0.0);
    const vreal<double> size = abs(root);
    const vreal<double> moved =
        abs(quadric_value<double>(quadric, start.p)) / max(abs(line.slope), vreal<double>(1e-300));
    return select(from_bits<double>(start.on_side), vreal<double>(clip_slack<double>) * size,
                  min(moved, vreal<double>(0x1p-10) * size));
}

/// Where rays from a point of the side hit the quadric again.
inline OwnCrossing crossing_from_side(const abi::QuadricRecord<double>& quadric,
                                      const Vec3v<double>& point, const Vec3v<double>& dir,
                                      const vreal<double>& t_min, vmask<double> outside)
{
    const vreal<double> zero(0.0);
    const auto [rounded, height] = quadric_origin<double>(quadric, point);
    const Vec3v<double> v = apply_inverse(quadric, dir);
    const Vec3v<double> scaled = broadcast(quadric.square) * v;
    const auto slope_at = [&](const Vec3v<double>& p) {
        return madd(vreal<double>(quadric.linear), v.z, dot(scaled, p));
    };
    SurfaceLine line{slope_at(rounded), bend_along<double>(quadric, scaled, v, dir)};
    const SideStart start = start_on_side(quadric, rounded, v, other_root(line, outside));
    line.slope = slope_at(start.p);
    vreal<double> root = other_root(line, outside);
    // For rays that pass an apex, slope and bend have lost digits that the surface there has.
    if (start.on_side != 0)
        for (int i = 0; i < 2; ++i)
            root = select(from_bits<double>(start.on_side),
                          bettered(quadric, start.p, v, root, zero), root);
    if (!quadric.clipped)
        return only_crossing(root, line.bend, t_min, outside);
    const ClipCrossings<double> clip = clip_crossings<double>(quadric, height, dir);
    const vreal<double> climb = dot(broadcast(quadric.clip), dir);
    const std::uint32_t climbs = bits(climb > zero);
    const vreal<double> out =
        select(climb == zero, vreal<double>(__builtin_inf()),
               max(select(from_bits<double>(climbs), clip.high_t, clip.low_t), zero));
    // If the surface bends away from the ray, the ray is inside up to the other root; if it bends
    // towards a ray outside, the ray is inside beyond the other root. A ray that leaves across the
    // gradient, as every ray from a cone's apex does, continues inside if the surface bends towards
    // it.
    const std::uint32_t bends_away = bits(line.bend > zero) & ~bits(outside);
    const std::uint32_t bends_towards = bits(line.bend < zero) & bits(root > zero) & bits(outside);
    const std::uint32_t by_side =
        (bends_away | bends_towards) & bits(root - place_error(quadric, start, line, root) <= out);
    const std::uint32_t goes_in = bits(line.bend < zero) & bits(line.slope == zero);
    const std::uint32_t ends_inside = quadric.capped ? by_side ^ (~bits(outside) | goes_in) : 0;
    return first_of({{root, root}, out, {by_side, 0}, ends_inside, climbs}, t_min);
}

/// Where rays from a point of a cap that enter the quadric hit it again.
inline OwnCrossing crossing_from_cap(const abi::QuadricRecord<double>& quadric, bool from_low,
                                     const Vec3v<double>& point, const Vec3v<double>& dir,
                                     const vreal<double>& t_min)
{
    const vreal<double> zero(0.0);
    const vreal<double> never(__builtin_inf());
    const vreal<double> far = vreal<double>(quadric.clip_high - quadric.clip_low) /
                              abs(dot(broadcast(quadric.clip), dir));
    const vreal<double> across = select(far < never, far, never);
    const auto [side, start] = side_quadratic<double>(
        quadric, quadric_origin<double>(quadric, point).p, apply_inverse(quadric, dir), dir);
    const vreal<double> root = with_sign_of(sqrt(max(side.discriminant, zero)), side.b);
    const vreal<double> minus_q = side.b + root;
    const auto at_start = minus_q == zero;
    const vreal<double> first =
        start + select(at_start, zero, lesser_root(side, root, minus_q, all_lanes<double>));
    const vreal<double> second = select(at_start, first, start + negated(minus_q) / side.a);
    const LineInterval<double> between = ordered<double>(first, second);
    const std::uint32_t along = bits(at_start & (side.a == zero));
    const std::uint32_t opens = bits(side.a < zero);
    const std::uint32_t gap = opens & bits(side.discriminant >= zero);
    // A quadric of two halves has a gap between them. It is ahead, or just behind if rounding put
    // the start into the half that is closer.
    const std::uint32_t before_gap =
        gap & bits(between.high > zero) & bits(between.low > negated(between.high));
    const vreal<double> leaves =
        max(select(from_bits<double>(opens), between.low, between.high), zero);
    const std::uint32_t by_side = ((~opens & ~along) | before_gap) & bits(leaves <= across);
    const std::uint32_t enters = by_side & before_gap & bits(between.high <= across);
    return first_of(
        {{leaves, between.high}, across, {by_side, enters}, ~by_side | enters, from_low ? ~0u : 0u},
        t_min);
}

inline HitAgain hit_again(const abi::QuadricRecord<double>& quadric, unsigned piece)
{
    const double(&s)[3] = quadric.square;
    return piece != 0 || (s[0] >= 0 && s[1] >= 0 && s[2] >= 0) ? HitAgain::from_inside
                                                               : HitAgain::from_anywhere;
}

/// Lanes in which the side certainly bends away from the line: rays that leave on the outer side do
/// not hit it again. v is off by five roundings of the rows' lengths, a sum of squares by five
/// more.
template <class Real>
inline std::uint32_t bends_away(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& dir)
{
    constexpr double rounding = sizeof(Real) == sizeof(float) ? 0x1p-24 : 0x1p-53;
    const Vec3v<Real> v = apply_inverse_as<Real>(quadric, dir);
    const vreal<Real> bend = dot(broadcast_as<Real>(quadric.square) * v, v);
    const vreal<Real> slack(static_cast<Real>(64 * rounding * quadric.bend_size));
    const vreal<Real> smallest(Real(0x1p-90));
    return bits(bend > max(slack * dot(dir, dir), smallest));
}

/// Lanes whose lines from inside have crossed the gap between the two halves of a quadric before
/// `place`, which is inside: the equation has a maximum along such a line, and falls at `place`.
inline std::uint32_t past_gap(const abi::QuadricRecord<double>& quadric, const Vec3v<double>& place,
                              const Vec3v<double>& way)
{
    const vreal<double> zero(0.0);
    const Vec3v<double> v = apply_inverse(quadric, way);
    const Vec3v<double> p = apply_inverse(quadric, place - broadcast(quadric.center));
    const Vec3v<double> scaled = broadcast(quadric.square) * v;
    const vreal<double> slope = madd(vreal<double>(quadric.linear), v.z, dot(scaled, p));
    return bits(dot(scaled, v) < zero) & bits(slope < zero);
}

inline OwnCrossing second_crossing(const abi::QuadricRecord<double>& quadric, unsigned piece,
                                   const Vec3v<double>& point, const Vec3v<double>& dir,
                                   const vreal<double>& t_min, vmask<double> outside)
{
    return piece == 0 ? crossing_from_side(quadric, point, dir, t_min, outside)
                      : crossing_from_cap(quadric, piece == 1, point, dir, t_min);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
