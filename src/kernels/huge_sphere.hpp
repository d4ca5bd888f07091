#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/quadratic.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// The ray against a sphere given by a surface point and its curvature (abi::HugeSphere). With
/// p the origin relative to the anchor and g = n + k p, F(t) = k a t² + 2 (g·d) t + (g + n)·p + k0:
/// no term is of the size of the radius, which a ground sphere's would drown in.
template <class Real>
inline Quadratic<Real> quadratic_of(const abi::HugeSphere<Real>& sphere,
                                    const RayPacket<Real>& rays)
{
    const vreal<Real> k(sphere.curvature);
    const Vec3v<Real> normal = broadcast(sphere.normal);
    const Vec3v<Real> p = rays.org - broadcast(sphere.anchor);
    const Vec3v<Real> g = madd<Real>(k, p, normal);
    Quadratic<Real> q;
    q.a = k * rays.dir2;
    q.b = dot(g, rays.dir);
    q.c = dot(g + normal, p) + vreal<Real>(sphere.offset);
    q.discriminant = msub(q.b, q.b, q.a * q.c);
    return q;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
