#pragma once

#include "kernels/closest.hpp"

// Which rays of a packet meet any object on the way to a light.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A segment from a point light to the shaded points: t in [0, t_end].
template <class Real>
struct SegmentEnd {
    vreal<Real> t_end;

    vmask<Real> blocked_by(const Quadratic<Real>& quadratic, const RayPacket<Real>& rays) const
    {
        return root_between(quadratic, rays.t_min, t_end);
    }
    vmask<Real> blocked_at(const vreal<Real>& t, const RayPacket<Real>& rays) const
    {
        return (t >= rays.t_min) & (t <= t_end);
    }
};

/// From the shaded points to a directional light: t > t_min without end.
template <class Real>
struct NoEnd {
    vmask<Real> blocked_by(const Quadratic<Real>& quadratic, const RayPacket<Real>& rays) const
    {
        return root_beyond(quadratic, rays.t_min);
    }
    vmask<Real> blocked_at(const vreal<Real>& t, const RayPacket<Real>& rays) const
    {
        return t >= rays.t_min;
    }
};

/// The lanes of `wanted` that are blocked. Stops as soon as all are.
template <class End, class Spheres, class Real>
inline std::uint32_t occluded(const End& end, const Spheres& spheres,
                              const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                              std::uint32_t wanted)
{
    std::uint32_t open = wanted;
    for (int i = 0; i < spheres.count && open != 0; ++i)
        open &= ~bits(end.blocked_by(quadratic_of(spheres, i, rays), rays));
    for (int i = 0; i < scene.huge_spheres.count && open != 0; ++i)
        open &= ~bits(end.blocked_by(quadratic_of(scene.huge_spheres.data[i], rays), rays));
    for (int i = 0; i < scene.planes.count && open != 0; ++i)
        open &= ~bits(end.blocked_at(plane_t(scene.planes.data[i], rays), rays));
    return wanted & ~open;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
