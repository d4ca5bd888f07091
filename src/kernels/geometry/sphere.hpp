#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/geometry/quadratic.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// |o|² - r² for the ray origin relative to the centre.
template <class Real>
inline vreal<Real> sphere_constant(const Vec3v<Real>& o, const vreal<Real>& radius2)
{
    return dot(o, o) - radius2;
}

/// The ray against |P|² = r², with `o` its origin relative to the centre. The discriminant is
/// Lagrange's form a r² - |o × d|², which does not cancel for distant spheres as b² - a c does.
template <class Real>
inline Quadratic<Real> sphere_quadratic(const RayPacket<Real>& rays, const Vec3v<Real>& o,
                                        const vreal<Real>& radius2, const vreal<Real>& constant)
{
    const Vec3v<Real> moment = cross(o, rays.dir);
    Quadratic<Real> q;
    q.a = rays.dir2;
    q.b = dot(o, rays.dir);
    q.c = constant;
    q.discriminant = msub(rays.dir2, radius2, dot(moment, moment));
    return q;
}

/// The sphere at `index` of a list.
template <class Real>
inline Quadratic<Real> quadratic_of(const abi::SphereListView<Real>& list, int index,
                                    const RayPacket<Real>& rays)
{
    const Vec3v<Real> center{vreal<Real>(list.center_x[index]), vreal<Real>(list.center_y[index]),
                             vreal<Real>(list.center_z[index])};
    const Vec3v<Real> o = rays.org - center;
    const vreal<Real> radius2(list.radius2[index]);
    return sphere_quadratic<Real>(rays, o, radius2, sphere_constant<Real>(o, radius2));
}

/// x |x|, so that no ray meets a sphere of negative radius.
template <class Real>
inline batch<Real> signed_square(batch<Real> x)
{
    return x * abs(x);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
