#pragma once

#include "kernels/geometry/packet.hpp"

#include <limits>

// The quadratic a t² + 2 b t + c = 0 with a > 0 that every curved surface comes down to, and
// its discriminant b² - a c, which each surface computes in its own stable way.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct Quadratic {
    vreal<Real> a, b, c;
    vreal<Real> discriminant;
};

/// From this share of q² on, rounding could have the lesser root be the larger.
template <class Real>
inline constexpr Real near_square = Real(1) - Real(8) * std::numeric_limits<Real>::epsilon();

/// The root of lesser size, -c / minus_q, of the lanes of `crosses`; minus_q is b plus
/// `signed_root`. By size the other, -minus_q/a, is no less; where it seems so, the line all but
/// touches the surface where its equation starts, and of c nothing but rounding is left, of which a
/// quotient could be anything. Where the two are one but for rounding the first is the first.
template <class Real>
inline vreal<Real> lesser_root(const Quadratic<Real>& quadratic, const vreal<Real>& signed_root,
                               const vreal<Real>& minus_q, std::uint32_t crosses)
{
    const vreal<Real> root = negated(quadratic.c) / minus_q;
    const vreal<Real> square = minus_q * minus_q;
    const vreal<Real> product = quadratic.a * quadratic.c;
    const auto near = abs(product) > vreal<Real>(near_square<Real>) * square;
    if ((bits(near) & crosses) == 0)
        return root;
    const vreal<Real> first = min(root, negated(minus_q) / quadratic.a);
    const vreal<Real> sum = (signed_root - quadratic.b) / quadratic.a;
    const vreal<Real> zero(Real(0));
    const auto twins = near & (quadratic.b < zero) & (product > zero);
    return select(abs(product) > square, sum, select(twins, first, root));
}

/// Lanes where a root may lie at t > 0: with b >= 0 and c >= 0 both roots are behind.
template <class Real>
inline vmask<Real> may_hit(const Quadratic<Real>& q)
{
    const vreal<Real> zero(Real(0));
    return (q.discriminant >= zero) & ((q.b < zero) | (q.c < zero));
}

/// Takes the smallest root beyond t_min, after Press et al., Numerical Recipes, section 5.6:
/// q = -(b + sign(b) √D), roots c/q and q/a, neither of which cancels. For t_min >= 0, c/q is
/// the first root that can count, and q/a only matters where b < 0 and c/q is too near.
template <class Real>
inline void keep_first_root(HitPacket<Real>& hit, const Quadratic<Real>& quadratic,
                            vmask<Real> active, const vreal<Real>& t_min, std::int32_t surface)
{
    // Lanes that miss may hold a NaN here; no comparison lets it through. -q is used for q.
    const vreal<Real> root = with_sign_of(sqrt(quadratic.discriminant), quadratic.b);
    const vreal<Real> minus_q = quadratic.b + root;
    vreal<Real> t = lesser_root(quadratic, root, minus_q, bits(active));
    const auto in_front = t > t_min;
    const std::uint32_t too_near = bits(active) & ~bits(in_front);
    if ((too_near & bits(minus_q < vreal<Real>(Real(0)))) == 0) {
        keep_closer<Real>(hit, active & in_front, t, surface);
        return;
    }
    const vreal<Real> other = negated(minus_q) / quadratic.a;
    const auto retry = from_bits<Real>(too_near) & (minus_q < vreal<Real>(Real(0)));
    t = select(retry, other, t);
    keep_closer<Real>(hit, active & (t > t_min), t, surface);
}

/// Calls `visit(valid, t)` for either root, which may be infinite or NaN, where one may lie at
/// t > 0: of what closest hits leave out rounding makes no hit here.
template <class Real, class Visit>
inline void visit_roots(const Quadratic<Real>& quadratic, const Visit& visit)
{
    const auto crosses = may_hit(quadratic);
    if (none(crosses))
        return;
    const vreal<Real> root = with_sign_of(sqrt(quadratic.discriminant), quadratic.b);
    const vreal<Real> minus_q = quadratic.b + root;
    visit(crosses, lesser_root(quadratic, root, minus_q, bits(crosses)));
    visit(crosses, negated(minus_q) / quadratic.a);
}

/// Of lanes whose quadratic is below zero at t_max as summed up, those where rounding has not made
/// it so: from far away its terms cancel. a F(t) is also (a t + b)² - discriminant, which loses
/// less where that root is near; `slope` is a t_max + b.
template <class Real>
inline vmask<Real> ends_inside(const Quadratic<Real>& q, const vreal<Real>& t_max,
                               const vreal<Real>& slope)
{
    const vreal<Real> slope2 = slope * slope;
    const vreal<Real> way = q.a * t_max;
    const vreal<Real> lost = madd(vreal<Real>(Real(2)) * way, abs(slope), slope2);
    const vreal<Real> lost_by_sum = madd(way, way, q.a * abs(q.c));
    const auto better = vreal<Real>(Real(16)) * lost < lost_by_sum;
    return from_bits<Real>((bits(slope2 < q.discriminant) | ~bits(better)) & all_lanes<Real>);
}

/// Lanes with a root between t_min and t_max, from the signs of the quadratic F at both ends:
/// either they differ, or both are positive and F dips below zero between them. No square
/// root, no division. At an infinite t_max F is positive, as a > 0.
template <class Real>
inline vmask<Real> root_between(const Quadratic<Real>& q, const vreal<Real>& t_min,
                                const vreal<Real>& t_max)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> slope_near = madd(q.a, t_min, q.b);
    const vreal<Real> slope_far = madd(q.a, t_max, q.b);
    const vreal<Real> near = madd(slope_near + q.b, t_min, q.c);
    const vreal<Real> far = madd(slope_far + q.b, t_max, q.c);
    const auto enters = (near < zero) & (far >= zero);
    auto leaves = (near >= zero) & (far < zero);
    if (any(leaves))
        leaves = leaves & ends_inside(q, t_max, slope_far);
    const auto dips = (near >= zero) & (far >= zero) & (q.discriminant >= zero) &
                      (slope_near < zero) & (slope_far > zero);
    return enters | leaves | dips;
}

template <class Real, class Own>
inline void keep_quadratic(HitPacket<Real>& hit, const Quadratic<Real>& quadratic,
                           const RayPacket<Real>& rays, std::int32_t surface, const Own& own)
{
    const auto active = may_hit(quadratic);
    if (any(active))
        keep_first_root<Real>(
            hit, quadratic,
            from_bits<Real>(bits(active) & own.template lanes_on_others<Real>(surface)), rays.t_min,
            surface);
}

/// The part of a ray where objects are in its way. One type serves all rays, and tells them apart
/// by a branch that is always right: a type each would be a copy of the hierarchy's traversal each.
template <class Real>
struct RayEnd {
    vreal<Real> t_end;  ///< infinite for directional lights
    /// [t_min, t_end], decided by signs alone, as between a shaded point and a light; or else
    /// (t_min, t_end), decided by the roots, as rays from outside have it.
    bool closed;

    vmask<Real> blocked_by(const Quadratic<Real>& quadratic, const RayPacket<Real>& rays) const
    {
        // A light nearer than where the note's shadow rays start leaves a range that ends before it
        // begins: nothing is in it.
        if (closed)
            return root_between(quadratic, rays.t_min, max(t_end, rays.t_min));
        std::uint32_t blocked = 0;
        visit_roots(quadratic, [&](vmask<Real> valid, const vreal<Real>& t) {
            blocked |= bits(valid & (t > rays.t_min) & (t < t_end));
        });
        return from_bits<Real>(blocked);
    }
    /// A ray that runs along a plane meets it at infinity, which is not in the way.
    vmask<Real> blocked_at(const vreal<Real>& t, const RayPacket<Real>& rays) const
    {
        const vreal<Real> never(static_cast<Real>(__builtin_inf()));
        return closed ? (t >= rays.t_min) & (t <= t_end) & (t < never)
                      : (t > rays.t_min) & (t < t_end);
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
