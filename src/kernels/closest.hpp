#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/candidates.hpp"
#include "kernels/huge_sphere.hpp"
#include "kernels/plane.hpp"

// Closest hits of a packet among lists of objects.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline void keep_quadratic(HitPacket<Real>& hit, const Quadratic<Real>& quadratic,
                           const RayPacket<Real>& rays, std::int32_t object)
{
    const auto active = may_hit(quadratic);
    if (any(active))
        keep_first_root<Real>(hit, quadratic, active, rays.t_min, object);
}

/// `Spheres` is a list of the scene's or of a beam's spheres.
template <class Spheres, class Real>
inline void closest_sphere(HitPacket<Real>& hit, const Spheres& spheres,
                           const RayPacket<Real>& rays)
{
    for (int i = 0; i < spheres.count; ++i)
        keep_quadratic(hit, quadratic_of(spheres, i, rays), rays,
                       static_cast<std::int32_t>(spheres.object[i]));
}

template <class Spheres, class Real>
inline void closest_hit(HitPacket<Real>& hit, const Spheres& spheres,
                        const abi::SceneView<Real>& scene, const RayPacket<Real>& rays)
{
    closest_sphere(hit, spheres, rays);
    for (int i = 0; i < scene.huge_spheres.count; ++i) {
        const abi::HugeSphere<Real>& sphere = scene.huge_spheres.data[i];
        keep_quadratic(hit, quadratic_of(sphere, rays), rays, sphere.object);
    }
    for (int i = 0; i < scene.planes.count; ++i)
        keep_plane(hit, scene.planes.data[i], rays);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
