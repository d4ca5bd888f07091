#pragma once

#include "kernels/geometry/packet.hpp"

#include <limits>

// The quadratic a t² + 2 b t + c = 0 with a > 0 that the test of every curved surface solves, and
// its discriminant b² - a c, which each kind of surface computes in its own stable way.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct Quadratic {
    vreal<Real> a, b, c;
    vreal<Real> discriminant;
};

/// If |a c| is above this share of q², rounding may make the smaller root the larger one.
template <class Real>
inline constexpr Real near_square = Real(1) - Real(8) * std::numeric_limits<Real>::epsilon();

/// The root of smaller magnitude, -c / minus_q, in the lanes of `crosses`; minus_q is b +
/// `signed_root`. Exactly computed, the other root, -minus_q / a, is no smaller. Where rounding
/// makes it smaller, the line nearly touches the surface at the equation's origin: c is only
/// rounding error, its quotient could be anything, and (signed_root - b) / a is used. Where both
/// roots are positive and equal up to rounding, the smaller is returned, so that the first root
/// stays the first.
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

/// Lanes in which a root may lie at t > 0. With b >= 0 and c >= 0 both roots are behind.
template <class Real>
inline vmask<Real> may_hit(const Quadratic<Real>& q)
{
    const vreal<Real> zero(Real(0));
    return (q.discriminant >= zero) & ((q.b < zero) | (q.c < zero));
}

/// Keeps the smallest root beyond t_min, after Press et al., Numerical Recipes, section 5.6: q =
/// -(b + sign(b) √D), roots c/q and q/a, neither of which cancels. For t_min >= 0, c/q is the first
/// root that can be beyond t_min; q/a matters only where b < 0 and c/q is before t_min.
template <class Real>
inline void keep_first_root(HitPacket<Real>& hit, const Quadratic<Real>& quadratic,
                            vmask<Real> active, const vreal<Real>& t_min, std::int32_t surface)
{
    // Lanes that miss may hold NaN here, which passes no comparison. The code uses -q instead of q.
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

/// Calls `visit(valid, t)` for both roots, which may be infinite or NaN. Lanes in which no root can
/// lie at t > 0 are not valid, as in keep_first_root(), so that rounding makes no additional hits.
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

/// Called where the sum of the quadratic's terms is negative at t_max. Returns the lanes in which
/// that is not due to rounding: from far away the terms cancel. a F(t) is also (a t + b)² -
/// discriminant, which loses fewer digits if a root is near t_max. `slope` is a t_max + b.
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
/// either they differ, or both are positive and F is negative somewhere between. It takes no square
/// root and no division. At an infinite t_max F is positive, as a > 0.
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

/// Whether the interval of a ray contains its ends.
enum class RayInterval : bool {
    open,   ///< (t_min, t_end), decided by the roots, as for rays from callers
    closed  ///< [t_min, t_end], decided by signs only, as between a shaded point and a light
};

/// Where a ray ends that is tested for occlusion, and its interval. One type serves all rays; the
/// branch on `interval` is predicted well. Two types would double the code of the BVH traversal.
template <class Real>
struct RayEnd {
    vreal<Real> t_end;  ///< infinite for directional lights
    RayInterval interval;

    vmask<Real> blocked_by(const Quadratic<Real>& quadratic, const RayPacket<Real>& rays) const
    {
        // A light closer than the t at which the note's shadow rays start gives an interval that
        // ends before it begins: it contains nothing.
        if (interval == RayInterval::closed)
            return root_between(quadratic, rays.t_min, max(t_end, rays.t_min));
        std::uint32_t blocked = 0;
        visit_roots(quadratic, [&](vmask<Real> valid, const vreal<Real>& t) {
            blocked |= bits(valid & (t > rays.t_min) & (t < t_end));
        });
        return from_bits<Real>(blocked);
    }
    /// A ray parallel to a plane hits it at infinity, which does not occlude.
    vmask<Real> blocked_at(const vreal<Real>& t, const RayPacket<Real>& rays) const
    {
        const vreal<Real> never(static_cast<Real>(__builtin_inf()));
        return interval == RayInterval::closed ? (t >= rays.t_min) & (t <= t_end) & (t < never)
                                               : (t > rays.t_min) & (t < t_end);
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
