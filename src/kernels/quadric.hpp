#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/quadratic.hpp"

// Quadrics after the inverse transform (abi::QuadricRecord).
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

/// The centre is subtracted in two parts, so that a quadric far from the origin keeps its digits.
template <class Real>
inline QuadricOrigin<Real> quadric_origin(const abi::QuadricRecord<Real>& quadric,
                                          const Vec3v<Real>& org)
{
    const Vec3v<Real> w = (org - broadcast(quadric.center)) - broadcast(quadric.center_low);
    const Vec3v<Real> p = apply_inverse(quadric, w);
    QuadricOrigin<Real> origin;
    origin.p = p;
    origin.height = dot(broadcast(quadric.clip), w) + vreal<Real>(quadric.clip_offset);
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

/// A ray's quadratic from its point nearest to the centre, `start` along it. There no term of
/// b² - a c and of c is larger than it must be; from a far origin those of an indefinite form
/// cancel, by some twenty times what the origin's own rounding makes (packtrace stress).
template <class Real>
struct NearQuadratic {
    Quadratic<Real> from_start;
    vreal<Real> start;
};

template <class Real>
inline NearQuadratic<Real> near_quadratic(const abi::QuadricRecord<Real>& quadric,
                                          const Vec3v<Real>& p, const Vec3v<Real>& v)
{
    const vreal<Real> start = negated(dot(p, v)) / dot(v, v);
    const Vec3v<Real> near = madd<Real>(start, v, p);
    const Vec3v<Real> scaled = broadcast(quadric.square) * v;
    Quadratic<Real> q;
    q.a = dot(scaled, v);
    q.b = madd(vreal<Real>(quadric.linear), v.z, dot(scaled, near));
    q.c = quadric_value<Real>(quadric, near);
    q.discriminant = msub(q.b, q.b, q.a * q.c);
    return {q, start};
}

/// Calls `visit(valid, t, piece)` for the places where the rays of `active` cross the clipped and
/// capped surface: piece 0 is the side, 1 and 2 the low and the high cap. A t may be infinite.
template <class Real, class Visit>
inline void visit_crossings(const abi::QuadricRecord<Real>& quadric,
                            const QuadricOrigin<Real>& origin, const RayPacket<Real>& rays,
                            const Visit& visit)
{
    const Vec3v<Real> v = apply_inverse(quadric, rays.dir);
    const auto [quadratic, start] = near_quadratic<Real>(quadric, origin.p, v);
    const vreal<Real> climb = dot(broadcast(quadric.clip), rays.dir);
    const vreal<Real> low(quadric.clip_low);
    const vreal<Real> high(quadric.clip_high);
    visit_roots(quadratic, [&, from = start](vmask<Real> crosses, const vreal<Real>& root) {
        const vreal<Real> t = from + root;
        auto valid = crosses;
        if (quadric.clipped) {
            const vreal<Real> height = madd(t, climb, origin.height);
            valid = valid & (height >= low) & (height <= high);
        }
        visit(valid, t, 0);
    });
    if (!quadric.capped)
        return;
    for (int cap = 1; cap <= 2; ++cap) {
        const vreal<Real> t = ((cap == 1 ? low : high) - origin.height) / climb;
        const vreal<Real> from_start = t - start;
        const vreal<Real> value =
            madd(madd(quadratic.a, from_start, quadratic.b + quadratic.b), from_start, quadratic.c);
        visit(value <= vreal<Real>(Real(0)), t, cap);
    }
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

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
