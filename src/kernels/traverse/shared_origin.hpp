#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/anchored_sphere.hpp"
#include "kernels/geometry/candidates.hpp"
#include "kernels/geometry/plane.hpp"
#include "kernels/geometry/quadric.hpp"

// All objects as rays see them that start from one point: what depends on the origin alone is
// computed once a tile, by the operations a single packet would use, so with the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct SharedOriginObjects {
    SharedOriginSpheres<Real> spheres;
    SharedOriginAnchored<Real>* anchored_spheres = nullptr;
    SharedOriginPlane<Real>* planes = nullptr;
    SharedOriginQuadric<Real>* quadrics = nullptr;
    int anchored_count = 0;
    int plane_count = 0;
    int quadric_count = 0;

    bool empty() const
    {
        return spheres.count + anchored_count + plane_count + quadric_count == 0;
    }
};

/// Whether rays of `cone` leave a convex surface behind them: they start outside and go the
/// way of its outward gradient.
template <class Real>
inline bool leaves_behind(const Cone<Real>& cone, const SharedOriginAnchored<Real>& sphere)
{
    const Real inwards[3] = {-sphere.g[0], -sphere.g[1], -sphere.g[2]};
    return sphere.constant > 0 && runs_against(cone, inwards);
}

/// The same for a plane: they run away from it on the side they start on.
template <class Real>
inline bool leaves_behind(const Cone<Real>& cone, const SharedOriginPlane<Real>& plane)
{
    const Real side = plane.height < 0 ? Real(-1) : Real(1);
    const Real towards[3] = {side * plane.normal[0], side * plane.normal[1],
                             side * plane.normal[2]};
    return plane.height != 0 && runs_against(cone, towards);
}

/// Quadrics are few enough to be looked at one by one.
template <class Real>
inline void find_quadrics(SharedOriginObjects<Real>& objects, const Cone<Real>& cone,
                          const abi::GeometryView<Real>& scene)
{
    const Vec3v<Real> origin = broadcast(cone.base);
    objects.quadric_count = 0;
    for (int i = 0; i < scene.quadrics.count; ++i) {
        const abi::QuadricRecord<Real>& quadric = scene.quadrics.data[i];
        const Vec3v<Real> to_bound = broadcast(quadric.bound) - origin;
        if (!cone.bounded || any(may_meet<Real>(cone, to_bound, vreal<Real>(quadric.bound_radius))))
            objects.quadrics[objects.quadric_count++] = share_origin<Real>(quadric, origin);
    }
}

/// Fills `objects` with what rays of `cone`, all from its base, may meet.
template <abi::Features F, class Real>
inline void find_objects(SharedOriginObjects<Real>& objects, const Cone<Real>& cone,
                         const abi::GeometryView<Real>& scene)
{
    find_candidates(objects.spheres, cone, scene.spheres);
    const Vec3v<Real> origin = broadcast(cone.base);
    objects.anchored_count = 0;
    for (int i = 0; i < scene.anchored_spheres.count; ++i) {
        const auto sphere = share_origin<Real>(scene.anchored_spheres.data[i], origin);
        if (!leaves_behind(cone, sphere))
            objects.anchored_spheres[objects.anchored_count++] = sphere;
    }
    objects.plane_count = 0;
    for (int i = 0; i < scene.planes.count; ++i) {
        const auto plane = share_origin<Real>(scene.planes.data[i], origin);
        if (!leaves_behind(cone, plane))
            objects.planes[objects.plane_count++] = plane;
    }
    if constexpr (F.quadrics)
        find_quadrics(objects, cone, scene);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
