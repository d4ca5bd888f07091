#pragma once

#include "kernels/precision/own_surface.hpp"
#include "kernels/stats/observe.hpp"
#include "kernels/traverse/filtered_objects.hpp"
#include "kernels/traverse/object_lists.hpp"

// Which rays of a packet meet any object on the way to a light.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The part of a ray where objects are in its way. One type serves all rays, and tells them apart
/// by a branch that is always right: a type each would be a copy of the hierarchy's traversal each.
template <class Real>
struct Reach {
    vreal<Real> t_end;  ///< infinite for directional lights
    /// [t_min, t_end], decided by signs alone, as between a shaded point and a light; or else
    /// (t_min, t_end), decided by the roots, as rays from outside have it.
    bool closed;

    vmask<Real> blocked_by(const Quadratic<Real>& quadratic, const RayPacket<Real>& rays) const
    {
        if (closed)
            return root_between(quadratic, rays.t_min, t_end);
        if (none(may_hit(quadratic)))
            return from_bits<Real>(0);
        std::uint32_t blocked = 0;
        visit_roots(quadratic, [&](vmask<Real> valid, const vreal<Real>& t) {
            blocked |= bits(valid & (t > rays.t_min) & (t < t_end));
        });
        return from_bits<Real>(blocked);
    }
    vmask<Real> blocked_at(const vreal<Real>& t, const RayPacket<Real>& rays) const
    {
        return closed ? (t >= rays.t_min) & (t <= t_end) : (t > rays.t_min) & (t < t_end);
    }
};

/// `blocked` without the lanes whose own body is what blocks them: whether that is in the way is
/// known without looking (leave_surface.hpp).
template <class Real>
inline std::uint32_t but_own(std::uint32_t blocked, const vint<Real>& own, std::int32_t first,
                             int pieces = 1)
{
    return blocked == 0 ? 0 : blocked & ~lanes_on_body<Real>(own, first, pieces);
}

/// Lanes that any piece of a quadric blocks, but for those that start on it.
template <class Quadric, class Real>
inline std::uint32_t quadric_blocks(const Reach<Real>& reach, const Quadric& quadric,
                                    const RayPacket<Real>& rays, const vint<Real>& own)
{
    const abi::QuadricRecord<Real>& record = record_of<Real>(quadric);
    std::uint32_t blocked = 0;
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int) {
        blocked |= bits(valid & reach.blocked_at(t, rays));
    });
    return but_own<Real>(blocked, own, record.surface, pieces_of(record));
}

/// What any piece of a quadric does to the lanes of `active` that do not start on it, in double.
inline Occlusion occludes(const abi::QuadricRecord<double>& quadric, const RayPacket<float>& rays,
                          const vreal<float>& t_end, const vint<float>& own, std::uint32_t active)
{
    Occlusion result;
    const std::uint32_t others = but_own<float>(active, own, quadric.surface, pieces_of(quadric));
    visit_in_double(
        quadric, rays, others,
        [&](std::uint32_t lanes_of, const vreal<float>& low, const vreal<float>& high, int) {
            const Occlusion at = root_between(low, high, lanes_of, rays.t_min, t_end);
            result.blocked |= at.blocked;
            result.unsure |= at.unsure;
        });
    result.unsure &= ~result.blocked;
    return result;
}

/// Calls `occluder(surface, lanes)` for each object with the lanes it blocks, until that returns
/// false. What a lane's `own` surface blocks does not count.
template <abi::Features F, class Objects, class Real, class Occluder>
inline void visit_occluders(const Reach<Real>& reach, const Objects& objects,
                            const RayPacket<Real>& rays, const vint<Real>& own,
                            const Occluder& but_for_own)
{
    const ObjectLists<Real, Objects> lists{objects};
    const auto occluder = [&](std::int32_t surface, std::uint32_t blocked) {
        return but_for_own(surface, but_own<Real>(blocked, own, surface));
    };
    const auto& spheres = lists.spheres();
    const TestScope at;
    for (int i = 0; i < spheres.count; ++i) {
        at.test(abi::Primitive::sphere);
        if (!occluder(static_cast<std::int32_t>(spheres.surface[i]),
                      bits(reach.blocked_by(quadratic_of(spheres, i, rays), rays))))
            return;
    }
    for (int i = 0; i < lists.anchored_count(); ++i) {
        at.test(abi::Primitive::anchored_sphere);
        if (!occluder(lists.anchored(i).surface,
                      bits(reach.blocked_by(quadratic_of(lists.anchored(i), rays), rays))))
            return;
    }
    for (int i = 0; i < lists.plane_count(); ++i) {
        at.test(abi::Primitive::plane);
        if (!occluder(lists.plane(i).surface,
                      bits(reach.blocked_at(plane_t(lists.plane(i), rays), rays))))
            return;
    }
    if constexpr (F.quadrics)
        for (int i = 0; i < lists.quadric_count(); ++i) {
            at.test(abi::Primitive::quadric);
            if (!but_for_own(record_of<Real>(lists.quadric(i)).surface,
                             quadric_blocks(reach, lists.quadric(i), rays, own)))
                return;
        }
}

/// The same by certain tests, until t_end, for rays of the origins that the objects' bounds are
/// for. Returns the lanes in which something may be in the way; those blocked may be among them.
template <abi::Features F, bool Shared, class Occluder>
inline std::uint32_t visit_occluders(const vreal<float>& t_end,
                                     const FilteredObjects<Shared>& objects,
                                     const RayPacket<float>& rays, const vint<float>& own,
                                     const Occluder& occluder)
{
    const RayScale scale(rays);
    const std::uint32_t certain = objects.certifiable ? bits(certifiable(rays)) : 0;
    std::uint32_t unsure = ~certain & all_lanes<float>;
    note_in_the_way(unsure, abi::Cause::magnitude);
    // Whether to go on.
    const auto take = [&](std::int32_t surface, const Occlusion& occlusion) {
        const std::uint32_t blocked = occlusion.blocked & certain;
        unsure |= but_own<float>(occlusion.unsure, own, surface);
        return blocked == 0 || occluder(surface, but_own<float>(blocked, own, surface));
    };
    const SphereFilters& spheres = objects.spheres;
    const TestScope at;
    for (int i = 0; i < spheres.count; ++i) {
        at.test(abi::Primitive::sphere);
        const Vec3v<float> w = origin_from<Shared>(spheres, i, rays);
        const SphereApproach near = approach(w, vreal<float>(spheres.bounds.outer2[i]), rays);
        if (any(near.near) &&
            !take(spheres.surface[i], occludes(test_of(spheres, i, w), near, rays, scale, t_end)))
            return unsure;
    }
    for (int i = 0; i < objects.anchored_count; ++i) {
        at.test(abi::Primitive::anchored_sphere);
        if (!take(objects.anchored_spheres[i].surface,
                  occludes<Shared>(objects.anchored_spheres[i], rays, scale, t_end)))
            return unsure;
    }
    for (int i = 0; i < objects.plane_count; ++i) {
        at.test(abi::Primitive::plane);
        if (!take(objects.planes[i].surface,
                  occludes<Shared>(objects.planes[i], rays, scale, t_end)))
            return unsure;
    }
    if constexpr (F.quadrics)
        for (int i = 0; i < objects.quadric_count; ++i) {
            at.test(abi::Primitive::quadric);
            const QuadricFilter& filter = objects.quadrics[i];
            const std::uint32_t active = may_hit<Shared>(filter, rays, scale, t_end);
            if (active == 0)
                continue;
            const Occlusion occlusion = occludes(*filter.wide, rays, t_end, own, active & certain);
            unsure |= occlusion.unsure;
            if (occlusion.blocked != 0 && !occluder(filter.record->surface, occlusion.blocked))
                return unsure;
        }
    return unsure;
}

/// The lanes of `wanted` that are blocked by anything but their own surface.
template <abi::Features F, class Objects, class Real>
inline std::uint32_t occluded(const Reach<Real>& reach, const Objects& objects,
                              const RayPacket<Real>& rays, const vint<Real>& own,
                              std::uint32_t wanted)
{
    std::uint32_t open = wanted;
    visit_occluders<F>(reach, objects, rays, own, [&](std::int32_t, std::uint32_t blocked) {
        open &= ~blocked;
        return open != 0;
    });
    return wanted & ~open;
}

/// The same by certain tests.
template <abi::Features F, bool Shared>
inline Occlusion occluded(const vreal<float>& t_end, const FilteredObjects<Shared>& objects,
                          const RayPacket<float>& rays, const vint<float>& own,
                          std::uint32_t wanted)
{
    std::uint32_t open = wanted;
    const std::uint32_t unsure =
        visit_occluders<F>(t_end, objects, rays, own, [&](std::int32_t, std::uint32_t blocked) {
            open &= ~blocked;
            return open != 0;
        });
    return {wanted & ~open, open & unsure};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
