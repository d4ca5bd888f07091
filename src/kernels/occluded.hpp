#pragma once

#include "kernels/object_lists.hpp"
#include "kernels/observe.hpp"

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

/// `blocked` without the lanes whose own surface is what blocks them: whether that is in the way
/// is known without looking (second_meeting.hpp).
template <class Real>
inline std::uint32_t but_own(std::uint32_t blocked, const vint<Real>& own, std::int32_t surface)
{
    if (blocked == 0)
        return 0;
    return blocked & ~bits(int_equal(own, vint<Real>(static_cast<lane_int<Real>>(surface))));
}

/// No ray's own surface.
template <class Real>
inline vint<Real> no_surface()
{
    return vint<Real>(lane_int<Real>(-1));
}

/// Lanes that any piece of a quadric blocks, but for their own.
template <class Quadric, class Real>
inline std::uint32_t quadric_blocks(const Reach<Real>& reach, const Quadric& quadric,
                                    const RayPacket<Real>& rays, const vint<Real>& own)
{
    const std::int32_t surface = record_of<Real>(quadric).surface;
    std::uint32_t blocked = 0;
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        blocked |= but_own<Real>(bits(valid & reach.blocked_at(t, rays)), own, surface + piece);
    });
    return blocked;
}

template <class Stiff, class Real>
[[gnu::noinline]] std::uint32_t stiff_blocks(const Reach<Real>& reach, const Stiff& stiff,
                                             const RayPacket<Real>& rays, const vint<Real>& own)
{
    std::uint32_t blocked = 0;
    visit_stiff(stiff, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        blocked |=
            but_own<Real>(bits(valid & reach.blocked_at(t, rays)), own, surface_of(stiff) + piece);
    });
    return blocked;
}

/// Calls `blocker(surface, lanes)` for each object with the lanes it blocks, until that returns
/// false. What a lane's `own` surface blocks does not count.
template <abi::Features F, class Objects, class Real, class Blocker>
inline void visit_blockers(const Reach<Real>& reach, const Objects& objects,
                           const RayPacket<Real>& rays, const vint<Real>& own,
                           const Blocker& but_for_own)
{
    const ObjectLists<Real, Objects> lists{objects};
    const auto blocker = [&](std::int32_t surface, std::uint32_t blocked) {
        return but_for_own(surface, but_own<Real>(blocked, own, surface));
    };
    const auto& spheres = lists.spheres();
    const TestScope at;
    for (int i = 0; i < spheres.count; ++i) {
        at.test(abi::Primitive::sphere);
        if (!blocker(static_cast<std::int32_t>(spheres.surface[i]),
                     bits(reach.blocked_by(quadratic_of(spheres, i, rays), rays))))
            return;
    }
    for (int i = 0; i < lists.huge_count(); ++i) {
        at.test(abi::Primitive::huge_sphere);
        if (!blocker(lists.huge(i).surface,
                     bits(reach.blocked_by(quadratic_of(lists.huge(i), rays), rays))))
            return;
    }
    for (int i = 0; i < lists.plane_count(); ++i) {
        at.test(abi::Primitive::plane);
        if (!blocker(lists.plane(i).surface,
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
    for_each_stiff(lists.stiff(), [&](const auto& stiff) {
        at.test(abi::Primitive::stiff);
        return but_for_own(surface_of(stiff), stiff_blocks(reach, stiff, rays, own));
    });
}

/// The lanes of `wanted` that are blocked by anything but their own surface.
template <abi::Features F, class Objects, class Real>
inline std::uint32_t occluded(const Reach<Real>& reach, const Objects& objects,
                              const RayPacket<Real>& rays, const vint<Real>& own,
                              std::uint32_t wanted)
{
    std::uint32_t open = wanted;
    visit_blockers<F>(reach, objects, rays, own, [&](std::int32_t, std::uint32_t blocked) {
        open &= ~blocked;
        return open != 0;
    });
    return wanted & ~open;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
