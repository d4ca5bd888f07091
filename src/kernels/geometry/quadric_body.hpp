#pragma once

#include "kernels/geometry/quadric_place.hpp"

// Where rays that start on a piece of a body meet that body again, in double. That the start is on
// the piece is known, whatever rounding made of the point: along the ray the side has a root at 0,
// the start is between the planes that clip, and at a cap it is inside the side. So every ray that
// enters a capped body leaves it, however near to a rim it starts; one that leaves it where it
// starts does so at the least number above 0.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The crossings ahead in their order: two of the side at most, then one of a cap.
struct CrossingsAhead {
    vreal<double> side[2];
    vreal<double> cap;
    std::uint32_t meets_side[2];
    std::uint32_t meets_cap;
    std::uint32_t cap_is_high;
};

/// The first of them beyond t_min.
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

/// A gradient as many times as large is much steeper.
inline constexpr double much_steeper = 4.0;

/// After the first step of Newton's, which leaves at most this of the distance, as many more leave
/// less than double tells.
inline constexpr double nearer_by_step = 0x1p-4;
inline constexpr int further_steps = 3;

/// Where rays start, and the lanes in which that is a point of the side but for double's rounding.
struct SideStart {
    Vec3v<double> p;
    std::uint32_t on_side = 0;
};

/// The point of the side next to `p`, which is near it; p itself where it is not near by the size
/// of the body.
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

/// Where on the side rays start whose start, as rounded, is `p`: as a rule p itself, as if it were
/// on the side. The rays' other end, `far_t` away, then has the same value of the equation, and is
/// further off the side than p is as the equation is less steep there. Where it is much less, as
/// next to a cone's apex, they start from the point of the side next to p.
inline SideStart start_on_side(const abi::QuadricRecord<double>& quadric, const Vec3v<double>& p,
                               const Vec3v<double>& v, const vreal<double>& far_t)
{
    // Their gradient is not that of one equation, and as steep everywhere.
    if (crossing_planes(quadric))
        return {p};
    const Vec3v<double> here = side_gradient<double>(quadric, p);
    const Vec3v<double> there = side_gradient<double>(quadric, madd<double>(far_t, v, p));
    const auto flatter =
        vreal<double>(much_steeper * much_steeper) * dot(there, there) < dot(here, here);
    return none(flatter) ? SideStart{p} : next_on_side(quadric, p, flatter);
}

/// How far rounding of the start, where the equation's left side is 0 but for that, moves the
/// side's `root` past the plane that clips it. One that only touches a bowl would cut a hole into
/// it; with caps the order of side and caps decides.
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

/// From a point of a quadric's side.
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
    // Of rays that pass an apex, slope and bend have lost digits that the surface there has.
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
    // The inside is ahead up to the other root where the surface bends away, beyond it where the
    // surface bends towards rays outside. A ray that leaves across the gradient, as every ray from
    // a cone's apex, goes on in the inside where the surface bends towards it.
    const std::uint32_t bends_away = bits(line.bend > zero) & ~bits(outside);
    const std::uint32_t bends_towards = bits(line.bend < zero) & bits(root > zero) & bits(outside);
    const std::uint32_t by_side =
        (bends_away | bends_towards) & bits(root - place_error(quadric, start, line, root) <= out);
    const std::uint32_t goes_in = bits(line.bend < zero) & bits(line.slope == zero);
    const std::uint32_t ends_inside = quadric.capped ? by_side ^ (~bits(outside) | goes_in) : 0;
    return first_of({{root, root}, out, {by_side, 0}, ends_inside, climbs}, t_min);
}

/// From a point of a cap into the body.
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
    // Of a body of two halves the gap between them is ahead, or just behind where rounding put the
    // start into its nearer half.
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

/// Lanes whose line the side surely bends away from: rays that leave its outer side don't meet it
/// again. v is off by five roundings of the rows' lengths, a sum of squares by five more.
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

/// Lanes whose ways from inside have crossed the gap between the two halves of a body before
/// `place`, which is inside: there the equation has a largest value along them, and falls.
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
