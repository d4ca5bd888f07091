#pragma once

#include "kernels/object_lists.hpp"
#include "kernels/observe.hpp"

// Closest hits of a packet among lists of objects.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline void keep_quadratic(HitPacket<Real>& hit, const Quadratic<Real>& quadratic,
                           const RayPacket<Real>& rays, std::int32_t surface)
{
    const auto active = may_hit(quadratic);
    if (any(active))
        keep_first_root<Real>(hit, quadratic, active, rays.t_min, surface);
}

template <class Plane, class Real>
inline void keep_plane(HitPacket<Real>& hit, const Plane& plane, const RayPacket<Real>& rays)
{
    const vreal<Real> t = plane_t(plane, rays);
    keep_closer<Real>(hit, t > rays.t_min, t, plane.surface);
}

template <class Quadric, class Real>
inline void keep_quadric(HitPacket<Real>& hit, const Quadric& quadric, const RayPacket<Real>& rays)
{
    const std::int32_t surface = record_of<Real>(quadric).surface;
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        keep_closer<Real>(hit, valid & (t > rays.t_min), t, surface + piece);
    });
}

/// Apart from the rest, which it would only make larger: most scenes have none.
template <class Stiff, class Real>
[[gnu::noinline]] void keep_stiff(HitPacket<Real>& hit, const Stiff& list,
                                  const RayPacket<Real>& rays)
{
    const PartScope part(abi::Part::stiff);
    for_each_stiff(list, [&](const auto& stiff) {
        count_tests(abi::Primitive::stiff, 1);
        visit_stiff(stiff, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
            keep_closer<Real>(hit, valid & (t > rays.t_min), t, surface_of(stiff) + piece);
        });
        return true;
    });
}

/// Rays against all objects of a scene, or from their shared origin against those of a beam.
template <abi::Features F, class Objects, class Real>
inline void closest_hit(HitPacket<Real>& hit, const Objects& objects, const RayPacket<Real>& rays)
{
    const ObjectLists<Real, Objects> lists{objects};
    const auto& spheres = lists.spheres();
    const TestScope at;
    at.test(abi::Primitive::sphere, spheres.count);
    for (int i = 0; i < spheres.count; ++i)
        keep_quadratic(hit, quadratic_of(spheres, i, rays), rays,
                       static_cast<std::int32_t>(spheres.surface[i]));
    at.test(abi::Primitive::huge_sphere, lists.huge_count());
    for (int i = 0; i < lists.huge_count(); ++i)
        keep_quadratic(hit, quadratic_of(lists.huge(i), rays), rays, lists.huge(i).surface);
    at.test(abi::Primitive::plane, lists.plane_count());
    for (int i = 0; i < lists.plane_count(); ++i)
        keep_plane(hit, lists.plane(i), rays);
    at.test(abi::Primitive::quadric, lists.quadric_count());
    if constexpr (F.quadrics)
        for (int i = 0; i < lists.quadric_count(); ++i)
            keep_quadric(hit, lists.quadric(i), rays);
    if (any_stiff(lists.stiff()))
        keep_stiff(hit, lists.stiff(), rays);
}

/// Calls `visit(valid, t, surface)` for every crossing of every surface of a scene; only those
/// where `valid`, and with a finite t, are one.
template <abi::Features F, class Real, class Visit>
inline void visit_all_crossings(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                                const Visit& visit)
{
    const auto quadratic_crossings = [&](const Quadratic<Real>& quadratic, std::int32_t surface) {
        visit_roots(quadratic,
                    [&](vmask<Real> valid, const vreal<Real>& t) { visit(valid, t, surface); });
    };
    for (int i = 0; i < scene.spheres.count; ++i)
        quadratic_crossings(quadratic_of(scene.spheres, i, rays),
                            static_cast<std::int32_t>(scene.spheres.surface[i]));
    for (int i = 0; i < scene.huge_spheres.count; ++i)
        quadratic_crossings(quadratic_of(scene.huge_spheres.data[i], rays),
                            scene.huge_spheres.data[i].surface);
    for (int i = 0; i < scene.planes.count; ++i)
        visit(from_bits<Real>(all_lanes<Real>), plane_t(scene.planes.data[i], rays),
              scene.planes.data[i].surface);
    if constexpr (F.quadrics)
        for (int i = 0; i < scene.quadrics.count; ++i)
            visit_crossings(scene.quadrics.data[i], rays,
                            [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
                                visit(valid, t, scene.quadrics.data[i].surface + piece);
                            });
    for_each_stiff(scene, [&](const auto& stiff) {
        visit_stiff(stiff, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
            visit(valid, t, surface_of(stiff) + piece);
        });
        return true;
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
