#pragma once

#include "kernels/traverse/shared_origin.hpp"

// One way to walk the objects of a scene and those of a cone.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real, class Objects>
struct ObjectLists;

template <class Real>
struct ObjectLists<Real, abi::GeometryView<Real>> {
    const abi::GeometryView<Real>& scene;

    const abi::SphereListView<Real>& spheres() const
    {
        return scene.spheres;
    }
    int anchored_count() const
    {
        return scene.anchored_spheres.count;
    }
    const abi::AnchoredSphere<Real>& anchored(int i) const
    {
        return scene.anchored_spheres.data[i];
    }
    int plane_count() const
    {
        return scene.planes.count;
    }
    const abi::PlaneRecord<Real>& plane(int i) const
    {
        return scene.planes.data[i];
    }
    int quadric_count() const
    {
        return scene.quadrics.count;
    }
    const abi::QuadricRecord<Real>& quadric(int i) const
    {
        return scene.quadrics.data[i];
    }
};

/// The objects of a scene as parallel rays see them: some of its spheres, and all others.
template <class Real>
struct ParallelObjects {
    const abi::GeometryView<Real>& scene;
    abi::SphereListView<Real> spheres;
};

template <class Real>
struct ObjectLists<Real, ParallelObjects<Real>> : ObjectLists<Real, abi::GeometryView<Real>> {
    const abi::SphereListView<Real>& met_spheres;

    explicit ObjectLists(const ParallelObjects<Real>& objects)
        : ObjectLists<Real, abi::GeometryView<Real>>{objects.scene}, met_spheres(objects.spheres)
    {
    }

    const abi::SphereListView<Real>& spheres() const
    {
        return met_spheres;
    }
};

template <class Real>
struct ObjectLists<Real, SharedOriginObjects<Real>> {
    const SharedOriginObjects<Real>& objects;

    const SharedOriginSpheres<Real>& spheres() const
    {
        return objects.spheres;
    }
    int anchored_count() const
    {
        return objects.anchored_count;
    }
    const SharedOriginAnchored<Real>& anchored(int i) const
    {
        return objects.anchored_spheres[i];
    }
    int plane_count() const
    {
        return objects.plane_count;
    }
    const SharedOriginPlane<Real>& plane(int i) const
    {
        return objects.planes[i];
    }
    int quadric_count() const
    {
        return objects.quadric_count;
    }
    const SharedOriginQuadric<Real>& quadric(int i) const
    {
        return objects.quadrics[i];
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
