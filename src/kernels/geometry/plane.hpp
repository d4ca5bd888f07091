#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/geometry/packet.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Height of the plane over the origin along its normal. The origin is taken relative to the
/// plane's point, which halves the error of n·point - n·org.
template <class Real>
inline vreal<Real> plane_height(const abi::PlaneRecord<Real>& plane, const Vec3v<Real>& org)
{
    return dot(broadcast(plane.normal), broadcast(plane.point) - org);
}

/// Where the rays cross a plane; infinite or NaN for rays along it.
template <class Real>
inline vreal<Real> plane_t(const abi::PlaneRecord<Real>& plane, const RayPacket<Real>& rays)
{
    return plane_height<Real>(plane, rays.org) / dot(broadcast(plane.normal), rays.dir);
}

/// A plane seen from an origin that all rays share.
template <class Real>
struct SharedOriginPlane {
    Real normal[3];
    Real height;
    std::int32_t surface;
};

template <class Real>
inline SharedOriginPlane<Real> share_origin(const abi::PlaneRecord<Real>& plane,
                                            const Vec3v<Real>& origin)
{
    return {{plane.normal[0], plane.normal[1], plane.normal[2]},
            first_lane<Real>(plane_height<Real>(plane, origin)),
            plane.surface};
}

template <class Real>
inline vreal<Real> plane_t(const SharedOriginPlane<Real>& plane, const RayPacket<Real>& rays)
{
    return vreal<Real>(plane.height) / dot(broadcast(plane.normal), rays.dir);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
