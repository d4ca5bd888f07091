#pragma once

#include <limits>
#include <type_traits>

#include "kernel_abi/features.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/observation.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/object_list.hpp"
#include "kernels/geometry/one_surface.hpp"

// Quadrics after the inverse transform (abi::QuadricRecord): the test, for rays from one point,
// too.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// What a quadric needs to know of a ray's origin, in the quadric's canonical space.
template <class Real>
struct QuadricOrigin {
    Vec3v<Real> p;
    vreal<Real> height;  ///< in the space that clipping goes by
};

template <class Real>
inline Vec3v<Real> apply_inverse(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& v)
{
    return {dot(broadcast(quadric.inverse[0]), v), dot(broadcast(quadric.inverse[1]), v),
            dot(broadcast(quadric.inverse[2]), v)};
}

/// The same by the record in double, in either precision.
template <class Real>
inline Vec3v<Real> apply_inverse_as(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& v)
{
    return {dot(broadcast_as<Real>(quadric.inverse[0]), v),
            dot(broadcast_as<Real>(quadric.inverse[1]), v),
            dot(broadcast_as<Real>(quadric.inverse[2]), v)};
}

/// A place of a record is subtracted in two parts, so that what is far from the origin keeps its
/// digits. In double it has one.
template <class Real>
inline Vec3v<Real> from_place(const Vec3v<Real>& org, const Real (&place)[3],
                              const Real (&place_low)[3])
{
    const Vec3v<Real> w = org - broadcast(place);
    return std::is_same_v<Real, double> ? w : w - broadcast(place_low);
}

template <class Real>
inline QuadricOrigin<Real> quadric_origin(const abi::QuadricRecord<Real>& quadric,
                                          const Vec3v<Real>& org)
{
    QuadricOrigin<Real> origin;
    origin.p = apply_inverse(quadric, from_place(org, quadric.center, quadric.center_low));
    origin.height =
        dot(broadcast(quadric.clip), from_place(org, quadric.clip_base, quadric.clip_base_low));
    return origin;
}

/// The left side of the equation at p.
template <class Real>
inline vreal<Real> quadric_value(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& p)
{
    const Vec3v<Real> squares = broadcast(quadric.square) * p;
    const vreal<Real> linear(quadric.linear);
    return madd(linear + linear, p.z, dot(squares, p)) + vreal<Real>(quadric.constant);
}

/// The discriminant by the moment m = p × v (Lagrange's identity), in which no term of the origin's
/// distance cancels, and which is never negative where no real ray can miss, as with crossing
/// planes: -k a - Σ s_j s_k m_i² + 2 l (s1 v_y m_x - s0 v_x m_y) + l² v_z².
template <class Real, class Stored>
inline vreal<Real> quadric_discriminant(const abi::QuadricRecord<Stored>& quadric,
                                        const Vec3v<Real>& m, const Vec3v<Real>& v,
                                        const vreal<Real>& a)
{
    const Vec3v<Real> s = broadcast_as<Real>(quadric.square);
    const vreal<Real> l(static_cast<Real>(quadric.linear));
    const vreal<Real> constant(static_cast<Real>(quadric.constant));
    const vreal<Real> squares =
        madd(s.y * s.z, m.x * m.x, madd(s.z * s.x, m.y * m.y, (s.x * s.y) * (m.z * m.z)));
    const vreal<Real> turn = msub(s.y * v.y, m.x, (s.x * v.x) * m.y);
    const vreal<Real> lifted = l * v.z;
    return madd(l + l, turn, msub(lifted, lifted, madd(constant, a, squares)));
}

/// How large the terms are that cancel in the left side of the equation at p.
template <class Real>
inline vreal<Real> value_size(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& p)
{
    const vreal<Real> lift = vreal<Real>(quadric.linear) * p.z;
    return madd(vreal<Real>(Real(2)), abs(lift), magnitude_dot(broadcast(quadric.square) * p, p)) +
           abs(vreal<Real>(quadric.constant));
}

/// The coefficient of t² along v in canonical space, `scaled` being v times the squares. What is no
/// more than its own rounding, or than what v is off by where the axes are turned, is 0: the ray
/// runs along a generator or an asymptote.
template <class Real>
inline vreal<Real> bend_along(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& scaled,
                              const Vec3v<Real>& v, const Vec3v<Real>& dir)
{
    const vreal<Real> bend = dot(scaled, v);
    constexpr Real rounding = sizeof(Real) == sizeof(float) ? Real(0x1p-22) : Real(0x1p-51);
    vreal<Real> slack = vreal<Real>(rounding) * magnitude_dot(scaled, v);
    if (quadric.turned) {
        const Vec3v<Real> size{magnitude_dot(broadcast(quadric.inverse[0]), dir),
                               magnitude_dot(broadcast(quadric.inverse[1]), dir),
                               magnitude_dot(broadcast(quadric.inverse[2]), dir)};
        slack = max(slack, vreal<Real>(8 * rounding) * magnitude_dot(scaled, size));
    }
    return select(abs(bend) <= slack, vreal<Real>(Real(0)), bend);
}

/// The ray p + t v in canonical space against the unclipped side, from `start` along it: mostly the
/// ray's point nearest to the centre, where no term is larger than it must be.
template <class Real>
struct SideQuadratic {
    Quadratic<Real> from_start;
    vreal<Real> start;
};

/// Whether a quadric is two planes that cross: s_i x_i² + s_j x_j² = 0.
template <class Real>
inline bool crossing_planes(const abi::QuadricRecord<Real>& quadric)
{
    const Real(&s)[3] = quadric.square;
    const int flat = (s[0] == 0) + (s[1] == 0) + (s[2] == 0);
    return quadric.constant == 0 && quadric.linear == 0 && flat == 1;
}

/// How large the terms are that cancel in b² - a c, by the sizes of what cancels in each of a, b
/// and c, and in what quadric_discriminant() gives.
template <class Real>
struct DiscriminantSizes {
    vreal<Real> by_terms, by_moment;
};

template <class Real>
inline DiscriminantSizes<Real> discriminant_sizes(const abi::QuadricRecord<Real>& quadric,
                                                  const SideQuadratic<Real>& side,
                                                  const Vec3v<Real>& p, const Vec3v<Real>& at,
                                                  const Vec3v<Real>& v)
{
    const Quadratic<Real>& q = side.from_start;
    const Vec3v<Real> s = broadcast(quadric.square);
    const Vec3v<Real> scaled = s * v;
    const Vec3v<Real> others{s.y * s.z, s.z * s.x, s.x * s.y};
    const Vec3v<Real> m = cross(at, v);
    const vreal<Real> two(Real(2));
    const vreal<Real> linear = abs(vreal<Real>(quadric.linear));
    const vreal<Real> climb = linear * abs(v.z);
    const vreal<Real> a = magnitude_dot(scaled, v);
    const vreal<Real> b = climb + madd(abs(side.start), a, magnitude_dot(scaled, p));
    const vreal<Real> c = value_size<Real>(quadric, at) + two * magnitude_dot(s * at, p);
    const vreal<Real> turn = madd(abs(scaled.y), abs(m.x), abs(scaled.x) * abs(m.y));
    DiscriminantSizes<Real> sizes;
    sizes.by_terms = madd(two * abs(q.b), b, madd(abs(q.a), c, abs(q.c) * a));
    sizes.by_moment = madd(abs(vreal<Real>(quadric.constant)), a, magnitude_dot(others * m, m)) +
                      madd(two * linear, turn, climb * climb);
    return sizes;
}

/// The side's quadratic of rays that nearly run along an asymptote, or along a straight line of the
/// surface. a is 0 there but for what cancels in it. The discriminant is b² or next to it, far
/// below the terms that cancel in what the moment gives, of which rounding would be left: b² - a c
/// is taken where it is off by less. Going from p to the nearest point rounds p, and b may be far
/// below that: b is made of p itself, and c is from where its terms are smaller. Of vectors in
/// registers, and not inlined, so that other rays don't pay for it.
template <class Real>
[[gnu::noinline]] SideQuadratic<Real> asymptotic_quadratic(const abi::QuadricRecord<Real>& quadric,
                                                           vreal<Real> px, vreal<Real> py,
                                                           vreal<Real> pz, vreal<Real> vx,
                                                           vreal<Real> vy, vreal<Real> vz,
                                                           vreal<Real> a, vreal<Real> start)
{
    const Vec3v<Real> p{px, py, pz};
    const Vec3v<Real> v{vx, vy, vz};
    const Vec3v<Real> near = madd<Real>(start, v, p);
    const vreal<Real> zero(Real(0));
    const auto stays = value_size<Real>(quadric, p) <= value_size<Real>(quadric, near);
    const Vec3v<Real> at = select(stays, p, near);
    SideQuadratic<Real> side;
    side.start = select(stays, zero, start);
    Quadratic<Real>& q = side.from_start;
    q.a = a;
    const vreal<Real> slope =
        madd(vreal<Real>(quadric.linear), v.z, dot(broadcast(quadric.square) * v, p));
    q.b = madd(side.start, a, slope);
    q.c = quadric_value<Real>(quadric, at);
    const auto sizes = discriminant_sizes<Real>(quadric, side, p, at, v);
    auto by_terms = a == zero;
    // What two planes have is a square, which is never negative.
    if (!crossing_planes(quadric))
        by_terms = by_terms | (vreal<Real>(Real(4)) * sizes.by_terms < sizes.by_moment);
    q.discriminant = select(by_terms, msub(q.b, q.b, a * q.c),
                            quadric_discriminant<Real>(quadric, cross(at, v), v, a));
    return side;
}

/// Where a ray is nearest to the centre, in the axes that the equation has: far along a cylinder is
/// no distance. 0 where the ray starts on the very surface, so that its root there is 0, too.
template <class Real>
inline vreal<Real> nearest_to_center(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& p,
                                     const Vec3v<Real>& v)
{
    const vreal<Real> zero(Real(0));
    const Vec3v<Real> counting = broadcast(quadric.counting) * v;
    const vreal<Real> way2 = dot(counting, v);
    const auto moves = (way2 > zero) & (abs(quadric_value<Real>(quadric, p)) > zero);
    return select(moves, negated(dot(p, counting)) / way2, zero);
}

template <class Real>
inline SideQuadratic<Real> side_quadratic(const abi::QuadricRecord<Real>& quadric,
                                          const Vec3v<Real>& p, const Vec3v<Real>& v,
                                          const Vec3v<Real>& dir)
{
    const Vec3v<Real> scaled = broadcast(quadric.square) * v;
    const vreal<Real> start = nearest_to_center<Real>(quadric, p, v);
    const Vec3v<Real> near = madd<Real>(start, v, p);
    Quadratic<Real> q;
    q.a = bend_along<Real>(quadric, scaled, v, dir);
    q.b = madd(vreal<Real>(quadric.linear), v.z, dot(scaled, near));
    q.c = quadric_value<Real>(quadric, near);
    q.discriminant = quadric_discriminant<Real>(quadric, cross(near, v), v, q.a);
    if (!quadric.has_asymptotes)
        return {q, start};
    const auto along = vreal<Real>(Real(16)) * abs(q.a) < magnitude_dot(scaled, v);
    if (none(along))
        return {q, start};
    const SideQuadratic<Real> other =
        asymptotic_quadratic<Real>(quadric, p.x, p.y, p.z, v.x, v.y, v.z, q.a, start);
    q.b = select(along, other.from_start.b, q.b);
    q.c = select(along, other.from_start.c, q.c);
    q.discriminant = select(along, other.from_start.discriminant, q.discriminant);
    return {q, select(along, other.start, start)};
}

/// The part of a line between two of its points, which may be infinitely far.
template <class Real>
struct LineInterval {
    vreal<Real> low, high;
};

template <class Real>
inline LineInterval<Real> ordered(const vreal<Real>& a, const vreal<Real>& b)
{
    return {min(a, b), max(a, b)};
}

/// Where the rays are between the clipping planes, and where they cross them. A ray along them is
/// between them all the way or nowhere.
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

/// The share of a t by which rounding may have a root lie beyond the plane that clips the surface
/// there. A plane that only touches a bowl would cut a hole into it otherwise.
template <class Real>
inline constexpr Real clip_slack = Real(4) * std::numeric_limits<Real>::epsilon();

/// Calls `visit(valid, t, piece)` for the places where the rays cross the clipped and capped
/// surface: piece 0 is the side, 1 and 2 the low and the high cap. A t may be infinite, and a piece
/// may be visited twice for different lanes. Side and caps share one decision, the order of their
/// t: at the rim a ray crosses exactly one, or, where it only touches the rim, both.
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
    // A ray through a cone's apex meets it at the start itself; one along a cylinder's axis
    // nowhere.
    const auto at_start = minus_q == zero;
    const std::uint32_t crosses = bits(quadratic.discriminant >= zero) &
                                  ~bits(at_start & (quadratic.a == zero)) & all_lanes<Real>;
    // Inside the unclipped surface all along.
    const std::uint32_t never_crosses =
        quadric.capped
            ? ~crosses & bits((quadratic.a < zero) | ((quadratic.a == zero) & (quadratic.c < zero)))
            : 0;
    if ((crosses | never_crosses) == 0)
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
    LineInterval<Real> kept = clip.between;
    if (!quadric.capped) {
        kept.low = kept.low - vreal<Real>(clip_slack<Real>) * (abs(kept.low) + abs(start));
        kept.high = kept.high + vreal<Real>(clip_slack<Real>) * (abs(kept.high) + abs(start));
    }
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
    // Rays come in by one cap and leave by the other. One that only touches the rim has two hits
    // there: it comes in by one piece and leaves by the other, in this order.
    const std::uint32_t comes_in[2] = {climbs, ~climbs};
    const vreal<Real> cap_t[2] = {clip.low_t, clip.high_t};
    const auto visit_cap = [&](int cap, std::uint32_t lanes_of) {
        const vreal<Real>& t = cap_t[cap];
        const std::uint32_t within = (comes_in[cap] & bits((t > side.low) & (t <= side.high))) |
                                     (~comes_in[cap] & bits((t >= side.low) & (t < side.high)));
        const std::uint32_t met = lanes_of & ((crosses & (opens ^ within)) | never_crosses);
        if (met != 0)
            visit(from_bits<Real>(met), t, cap + 1);
    };
    for (int cap = 0; cap < 2; ++cap)
        visit_cap(cap, comes_in[cap]);
    visit_side();
    for (int cap = 0; cap < 2; ++cap)
        visit_cap(cap, ~comes_in[cap]);
}

/// A quadric seen from an origin that all rays share.
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

/// How many surfaces a quadric has: its side, and two caps where it is capped.
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

template <class Object, class Real>
concept IsQuadric = std::is_same_v<Object, abi::QuadricRecord<Real>> ||
    std::is_same_v<Object, SharedOriginQuadric<Real>>;

/// Keeps what is closer, but for the lanes of `own`.
template <class Object, class Real, class Own>
requires IsQuadric<Object, Real>
inline void keep_closest(HitPacket<Real>& hit, const Object& quadric, const RayPacket<Real>& rays,
                         const Own& own)
{
    const Body body = body_of(quadric);
    const std::uint32_t others = own.template lanes_on_others<Real>(body.first, body.pieces);
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        std::uint32_t counts = others & bits(valid & (t > rays.t_min));
        // A ray that touches the rim enters by the cap where the cap was visited first.
        const std::uint32_t ties = piece == 0 ? counts & bits(t == hit.t) : 0;
        if (ties != 0)
            counts &= ~(ties & lanes_on_body<Real>(hit.surface, body.first + 1, body.pieces - 1));
        keep_closer<Real>(hit, from_bits<Real>(counts), t, body.first + piece);
    });
}
/// Lanes that any piece is in the way of.
template <class Object, class Real>
requires IsQuadric<Object, Real>
inline std::uint32_t occluding_lanes(const RayEnd<Real>& end, const Object& quadric,
                                     const RayPacket<Real>& rays)
{
    std::uint32_t blocked = 0;
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int) {
        blocked |= bits(valid & end.blocked_at(t, rays));
    });
    return blocked;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
