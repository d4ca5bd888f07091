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

template <class End, class Real>
struct OcclusionTest {
    const End& end;
    const RayPacket<Real>& rays;
    std::uint32_t open;  ///< lanes still to be decided

    template <class Spheres>
    void spheres(const Spheres& list)
    {
        for (int i = 0; i < list.count && open != 0; ++i)
            open &= ~bits(end.blocked_by(quadratic_of(list, i, rays), rays));
    }
    template <class HugeSphere>
    void huge_spheres(const HugeSphere* list, int count)
    {
        for (int i = 0; i < count && open != 0; ++i)
            open &= ~bits(end.blocked_by(quadratic_of(list[i], rays), rays));
    }
    template <class Plane>
    void planes(const Plane* list, int count)
    {
        for (int i = 0; i < count && open != 0; ++i)
            open &= ~bits(end.blocked_at(plane_t(list[i], rays), rays));
    }
};

/// The lanes of `wanted` that are blocked, for rays from anywhere.
template <class End, class Real>
inline std::uint32_t occluded(const End& end, const abi::SceneView<Real>& scene,
                              const RayPacket<Real>& rays, std::uint32_t wanted)
{
    OcclusionTest<End, Real> test{end, rays, wanted};
    test.spheres(scene.spheres);
    test.huge_spheres(scene.huge_spheres.data, scene.huge_spheres.count);
    test.planes(scene.planes.data, scene.planes.count);
    return wanted & ~test.open;
}

/// The same for rays from the objects' shared origin.
template <class End, class Real>
inline std::uint32_t occluded(const End& end, const SharedOriginObjects<Real>& objects,
                              const RayPacket<Real>& rays, std::uint32_t wanted)
{
    OcclusionTest<End, Real> test{end, rays, wanted};
    test.spheres(objects.spheres);
    test.huge_spheres(objects.huge_spheres, objects.huge_count);
    test.planes(objects.planes, objects.plane_count);
    return wanted & ~test.open;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
