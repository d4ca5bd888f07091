#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/packet.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where the rays cross a plane; infinite or NaN for rays along it. The origin is taken
/// relative to the plane's point, which halves the error of n·P - n·point.
template <class Real>
inline vreal<Real> plane_t(const abi::PlaneRecord<Real>& plane, const RayPacket<Real>& rays)
{
    const Vec3v<Real> normal = broadcast(plane.normal);
    return dot(normal, broadcast(plane.point) - rays.org) / dot(normal, rays.dir);
}

template <class Real>
inline void keep_plane(HitPacket<Real>& hit, const abi::PlaneRecord<Real>& plane,
                       const RayPacket<Real>& rays)
{
    const vreal<Real> t = plane_t(plane, rays);
    keep_closer(hit, t > rays.t_min, t, plane.object);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
