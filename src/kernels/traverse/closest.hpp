#pragma once

#include "kernels/precision/own_surface.hpp"
#include "kernels/stats/observe.hpp"
#include "kernels/traverse/filtered_objects.hpp"
#include "kernels/traverse/object_lists.hpp"

// Closest hits of a packet among lists of objects.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real, class Own>
inline void keep_quadratic(HitPacket<Real>& hit, const Quadratic<Real>& quadratic,
                           const RayPacket<Real>& rays, std::int32_t surface, const Own& own)
{
    const auto active = may_hit(quadratic);
    if (any(active))
        keep_first_root<Real>(
            hit, quadratic,
            from_bits<Real>(bits(active) & own.template lanes_on_others<Real>(surface)), rays.t_min,
            surface);
}

template <class Plane, class Real, class Own>
inline void keep_plane(HitPacket<Real>& hit, const Plane& plane, const RayPacket<Real>& rays,
                       const Own& own)
{
    const vreal<Real> t = plane_t(plane, rays);
    const std::uint32_t ahead = bits(t > rays.t_min);
    keep_closer<Real>(hit,
                      from_bits<Real>(ahead & own.template lanes_on_others<Real>(plane.surface)), t,
                      plane.surface);
}

template <class Quadric, class Real, class Own>
inline void keep_quadric(HitPacket<Real>& hit, const Quadric& quadric, const RayPacket<Real>& rays,
                         const Own& own)
{
    const abi::QuadricRecord<Real>& record = record_of<Real>(quadric);
    const std::uint32_t others =
        own.template lanes_on_others<Real>(record.surface, pieces_of(record));
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        std::uint32_t counts = others & bits(valid & (t > rays.t_min));
        // A ray that touches the rim enters by the cap where the cap was visited first.
        const std::uint32_t ties = piece == 0 ? counts & bits(t == hit.t) : 0;
        if (ties != 0)
            counts &= ~(
                ties & lanes_on_body<Real>(hit.surface, record.surface + 1, pieces_of(record) - 1));
        keep_closer<Real>(hit, from_bits<Real>(counts), t, record.surface + piece);
    });
}

/// Rays against all objects of a scene, or from their shared origin against those of a cone.
template <abi::Features F, class Objects, class Real, class Own>
inline void closest_hit(HitPacket<Real>& hit, const Objects& objects, const RayPacket<Real>& rays,
                        const Own& own)
{
    const ObjectLists<Real, Objects> lists{objects};
    const auto& spheres = lists.spheres();
    const TestScope at;
    at.test(abi::Primitive::sphere, spheres.count);
    for (int i = 0; i < spheres.count; ++i)
        keep_quadratic(hit, quadratic_of(spheres, i, rays), rays,
                       static_cast<std::int32_t>(spheres.surface[i]), own);
    at.test(abi::Primitive::anchored_sphere, lists.anchored_count());
    for (int i = 0; i < lists.anchored_count(); ++i)
        keep_quadratic(hit, quadratic_of(lists.anchored(i), rays), rays, lists.anchored(i).surface,
                       own);
    at.test(abi::Primitive::plane, lists.plane_count());
    for (int i = 0; i < lists.plane_count(); ++i)
        keep_plane(hit, lists.plane(i), rays, own);
    at.test(abi::Primitive::quadric, lists.quadric_count());
    if constexpr (F.quadrics)
        for (int i = 0; i < lists.quadric_count(); ++i)
            keep_quadric(hit, lists.quadric(i), rays, own);
}

/// A sphere by certain tests, for a packet of rays.
template <class Own>
inline void keep_sphere(HitPacket<float>& hit, const SphereTest& test, const SphereApproach& near,
                        const RayPacket<float>& rays, const RayScale& scale, std::int32_t surface,
                        const Own& own)
{
    const std::uint32_t others = bits(near.near) & own.template lanes_on_others<float>(surface);
    if (others != 0)
        keep_near_sphere(hit, test, {near.moment2, from_bits<float>(others)}, rays, scale, surface);
}

/// A quadric likewise; what may hit it is tested in double.
template <bool Shared, class Own>
inline void keep_quadric(HitPacket<float>& hit, const QuadricFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const std::int32_t surface = filter.record->surface;
    const std::uint32_t active =
        may_hit<Shared>(filter, rays, scale, hit.t) &
        own.template lanes_on_others<float>(surface, pieces_of(*filter.record));
    if (active == 0)
        return;
    visit_in_double(
        *filter.wide, rays, active,
        [&](std::uint32_t lanes_of, const vreal<float>& low, const vreal<float>& high, int piece) {
            keep_sure(hit, from_bits<float>(lanes_of), low, high, surface + piece);
        });
}

/// The same by certain tests, for rays of the origins that the objects' bounds are for.
template <abi::Features F, bool Shared, class Own>
inline void closest_hit(HitPacket<float>& hit, const FilteredObjects<Shared>& objects,
                        const RayPacket<float>& rays, const Own& own)
{
    const RayScale scale(rays);
    const SphereFilters& spheres = objects.spheres;
    const TestScope at;
    at.test(abi::Primitive::sphere, spheres.count);
    for (int i = 0; i < spheres.count; ++i) {
        const Vec3v<float> w = origin_from<Shared>(spheres, i, rays);
        const SphereApproach near = approach(w, vreal<float>(spheres.bounds.outer2[i]), rays);
        if (any(near.near))
            keep_sphere(hit, test_of(spheres, i, w), near, rays, scale, spheres.surface[i], own);
    }
    at.test(abi::Primitive::anchored_sphere, objects.anchored_count);
    for (int i = 0; i < objects.anchored_count; ++i)
        keep_anchored<Shared>(
            hit, objects.anchored_spheres[i], rays, scale,
            own.template lanes_on_others<float>(objects.anchored_spheres[i].surface));
    at.test(abi::Primitive::plane, objects.plane_count);
    for (int i = 0; i < objects.plane_count; ++i)
        keep_plane<Shared>(hit, objects.planes[i], rays, scale,
                           own.template lanes_on_others<float>(objects.planes[i].surface));
    at.test(abi::Primitive::quadric, objects.quadric_count);
    if constexpr (F.quadrics)
        for (int i = 0; i < objects.quadric_count; ++i)
            keep_quadric<Shared>(hit, objects.quadrics[i], rays, scale, own);
    if (!objects.certifiable)
        doubt_all(hit, from_bits<float>(all_lanes<float>));
    else
        doubt_all(hit, from_bits<float>(~bits(certifiable(rays)) & all_lanes<float>));
}

/// Calls `visit(valid, t, surface)` for every crossing of every surface in a scene's lists; only
/// those where `valid`, and with a finite t, are one.
template <abi::Features F, class Real, class Visit>
inline void visit_all_crossings(const abi::GeometryView<Real>& scene, const RayPacket<Real>& rays,
                                const Visit& visit)
{
    const auto quadratic_crossings = [&](const Quadratic<Real>& quadratic, std::int32_t surface) {
        visit_roots(quadratic,
                    [&](vmask<Real> valid, const vreal<Real>& t) { visit(valid, t, surface); });
    };
    for (int i = 0; i < scene.spheres.count; ++i)
        quadratic_crossings(quadratic_of(scene.spheres, i, rays),
                            static_cast<std::int32_t>(scene.spheres.surface[i]));
    for (int i = 0; i < scene.anchored_spheres.count; ++i)
        quadratic_crossings(quadratic_of(scene.anchored_spheres.data[i], rays),
                            scene.anchored_spheres.data[i].surface);
    for (int i = 0; i < scene.planes.count; ++i)
        visit(from_bits<Real>(all_lanes<Real>), plane_t(scene.planes.data[i], rays),
              scene.planes.data[i].surface);
    if constexpr (F.quadrics)
        for (int i = 0; i < scene.quadrics.count; ++i)
            visit_crossings(scene.quadrics.data[i], rays,
                            [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
                                visit(valid, t, scene.quadrics.data[i].surface + piece);
                            });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
