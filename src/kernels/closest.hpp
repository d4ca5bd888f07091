#pragma once

#include "kernels/shared_origin.hpp"

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

template <class Plane, class Real>
inline void keep_plane(HitPacket<Real>& hit, const Plane& plane, const RayPacket<Real>& rays)
{
    const vreal<Real> t = plane_t(plane, rays);
    keep_closer<Real>(hit, t > rays.t_min, t, plane.object);
}

/// Rays from anywhere against all objects of the scene.
template <class Real>
inline void closest_hit(HitPacket<Real>& hit, const abi::SceneView<Real>& scene,
                        const RayPacket<Real>& rays)
{
    closest_sphere(hit, scene.spheres, rays);
    for (int i = 0; i < scene.huge_spheres.count; ++i) {
        const abi::HugeSphere<Real>& sphere = scene.huge_spheres.data[i];
        keep_quadratic(hit, quadratic_of(sphere, rays), rays, sphere.object);
    }
    for (int i = 0; i < scene.planes.count; ++i)
        keep_plane(hit, scene.planes.data[i], rays);
}

/// Rays from the objects' shared origin against those objects.
template <class Real>
inline void closest_hit(HitPacket<Real>& hit, const SharedOriginObjects<Real>& objects,
                        const RayPacket<Real>& rays)
{
    closest_sphere(hit, objects.spheres, rays);
    for (int i = 0; i < objects.huge_count; ++i) {
        const SharedOriginHuge<Real>& sphere = objects.huge_spheres[i];
        keep_quadratic(hit, quadratic_of(sphere, rays), rays, sphere.object);
    }
    for (int i = 0; i < objects.plane_count; ++i)
        keep_plane(hit, objects.planes[i], rays);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
