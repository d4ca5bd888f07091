#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/candidates.hpp"
#include "kernels/huge_sphere.hpp"
#include "kernels/plane.hpp"

// All objects as rays see them that start from one point: what depends on the origin alone is
// computed once a tile, by the operations a single packet would use, so with the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct SharedOriginObjects {
    SharedOriginSpheres<Real> spheres;
    SharedOriginHuge<Real>* huge_spheres = nullptr;
    SharedOriginPlane<Real>* planes = nullptr;
    int huge_count = 0;
    int plane_count = 0;
};

/// Fills `objects` with what rays of `beam`, all from its base, may meet.
template <class Real>
inline void find_objects(SharedOriginObjects<Real>& objects, const Beam<Real>& beam,
                         const abi::SceneView<Real>& scene)
{
    find_candidates(objects.spheres, beam, scene.spheres);
    const Vec3v<Real> origin = broadcast(beam.base);
    objects.huge_count = scene.huge_spheres.count;
    for (int i = 0; i < objects.huge_count; ++i)
        objects.huge_spheres[i] = share_origin<Real>(scene.huge_spheres.data[i], origin);
    objects.plane_count = scene.planes.count;
    for (int i = 0; i < objects.plane_count; ++i)
        objects.planes[i] = share_origin<Real>(scene.planes.data[i], origin);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
