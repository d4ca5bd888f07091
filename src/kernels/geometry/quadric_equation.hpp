#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/geometry/one_surface.hpp"
#include "kernels/geometry/quadratic.hpp"

#include <type_traits>

// The equation of a quadric's unclipped side in canonical space, after the inverse transform
// (abi::QuadricRecord), and along rays.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A ray's origin in the quadric's canonical space.
template <class Real>
struct QuadricOrigin {
    Vec3v<Real> p;
    vreal<Real> height;  ///< height in the space that clipping uses
};

template <class Real>
inline Vec3v<Real> apply_inverse(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& v)
{
    return {dot(broadcast(quadric.inverse[0]), v), dot(broadcast(quadric.inverse[1]), v),
            dot(broadcast(quadric.inverse[2]), v)};
}

/// The same with the record in double, in either precision.
template <class Real>
inline Vec3v<Real> apply_inverse_as(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& v)
{
    return {dot(broadcast_as<Real>(quadric.inverse[0]), v),
            dot(broadcast_as<Real>(quadric.inverse[1]), v),
            dot(broadcast_as<Real>(quadric.inverse[2]), v)};
}

/// The origin relative to a point of a record. In single precision the point is subtracted in two
/// parts, so that far objects keep their digits.
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

/// The value of the equation's left side at p.
template <class Real>
inline vreal<Real> quadric_value(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& p)
{
    const Vec3v<Real> squares = broadcast(quadric.square) * p;
    const vreal<Real> linear(quadric.linear);
    return madd(linear + linear, p.z, dot(squares, p)) + vreal<Real>(quadric.constant);
}

/// The discriminant computed from the moment m = p × v (Lagrange's identity): -k a - Σ s_j s_k m_i²
/// + 2 l (s1 v_y m_x - s0 v_x m_y) + l² v_z². No term of the origin's distance cancels, and it is
/// never negative where no real line can miss, as with intersecting planes.
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

/// The magnitude of the terms that cancel in the equation's left side at p.
template <class Real>
inline vreal<Real> value_size(const abi::QuadricRecord<Real>& quadric, const Vec3v<Real>& p)
{
    const vreal<Real> lift = vreal<Real>(quadric.linear) * p.z;
    return madd(vreal<Real>(Real(2)), abs(lift), magnitude_dot(broadcast(quadric.square) * p, p)) +
           abs(vreal<Real>(quadric.constant));
}

/// The coefficient of t² along v in canonical space; `scaled` is v times the squares. It is set to
/// 0 where it is no larger than its own rounding error, or than the error of v where the axes are
/// turned: the ray is parallel to a generator or an asymptote.
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

/// The ray p + t v in canonical space against the unclipped side, as a quadratic from `start` on.
/// The start is mostly the ray's point closest to the centre, where the terms are smallest.
template <class Real>
struct SideQuadratic {
    Quadratic<Real> from_start;
    vreal<Real> start;
};

/// Whether a quadric is two planes that intersect: s_i x_i² + s_j x_j² = 0.
template <class Real>
inline bool crossing_planes(const abi::QuadricRecord<Real>& quadric)
{
    const Real(&s)[3] = quadric.square;
    const int flat = (s[0] == 0) + (s[1] == 0) + (s[2] == 0);
    return quadric.constant == 0 && quadric.linear == 0 && flat == 1;
}

/// The magnitude of the terms that cancel in b² - a c, including those that cancel within a, b and
/// c, and of the terms that cancel in quadric_discriminant().
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

/// The quadratic of rays nearly parallel to an asymptote, or to a straight line on the surface.
/// There the terms of a cancel to nearly 0, and the discriminant is close to b², far below the
/// terms that cancel in quadric_discriminant(): only rounding error would be left. So b² - a c is
/// used where its error is smaller. Moving from p to the closest point rounds p, and b may be far
/// smaller than that error: b is computed at p itself, and c where its terms are smaller. The
/// parameters are in registers and the function is not inlined, so that other rays do not pay for
/// it.
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
    // The discriminant of two planes is a square, and never negative.
    if (!crossing_planes(quadric))
        by_terms = by_terms | (vreal<Real>(Real(4)) * sizes.by_terms < sizes.by_moment);
    q.discriminant = select(by_terms, msub(q.b, q.b, a * q.c),
                            quadric_discriminant<Real>(quadric, cross(at, v), v, a));
    return side;
}

/// The t at which a ray is closest to the centre, measured along the axes that occur in the
/// equation: a distance along a cylinder does not count. 0 where the ray starts exactly on the
/// surface, so that its root there is 0 too.
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

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
