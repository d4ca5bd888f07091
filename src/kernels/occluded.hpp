#pragma once

#include "kernels/object_lists.hpp"
#include "kernels/observe.hpp"

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

/// Any range from t_min to t_max, for rays from outside.
template <class Real>
struct StreamRange {
    vreal<Real> t_max;

    vmask<Real> blocked_by(const Quadratic<Real>& quadratic, const RayPacket<Real>& rays) const
    {
        std::uint32_t blocked = 0;
        visit_roots(quadratic, [&](vmask<Real> valid, const vreal<Real>& t) {
            blocked |= bits(valid & blocked_at(t, rays));
        });
        return from_bits<Real>(blocked);
    }
    vmask<Real> blocked_at(const vreal<Real>& t, const RayPacket<Real>& rays) const
    {
        return (t > rays.t_min) & (t < t_max);
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
template <class End, class Quadric, class Real>
inline std::uint32_t quadric_blocks(const End& end, const Quadric& quadric,
                                    const RayPacket<Real>& rays, const vint<Real>& own)
{
    const std::int32_t surface = record_of<Real>(quadric).surface;
    std::uint32_t blocked = 0;
    visit_crossings(quadric, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        blocked |= but_own<Real>(bits(valid & end.blocked_at(t, rays)), own, surface + piece);
    });
    return blocked;
}

template <class End, class Stiff, class Real>
[[gnu::noinline]] std::uint32_t stiff_blocks(const End& end, const Stiff& stiff,
                                             const RayPacket<Real>& rays, const vint<Real>& own)
{
    std::uint32_t blocked = 0;
    visit_stiff(stiff, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
        blocked |=
            but_own<Real>(bits(valid & end.blocked_at(t, rays)), own, surface_of(stiff) + piece);
    });
    return blocked;
}

/// Calls `blocker(surface, lanes)` for each object with the lanes it blocks, until that returns
/// false. What a lane's `own` surface blocks does not count.
template <abi::Features F, class End, class Objects, class Real, class Blocker>
inline void visit_blockers(const End& end, const Objects& objects, const RayPacket<Real>& rays,
                           const vint<Real>& own, const Blocker& but_for_own)
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
                     bits(end.blocked_by(quadratic_of(spheres, i, rays), rays))))
            return;
    }
    for (int i = 0; i < lists.huge_count(); ++i) {
        at.test(abi::Primitive::huge_sphere);
        if (!blocker(lists.huge(i).surface,
                     bits(end.blocked_by(quadratic_of(lists.huge(i), rays), rays))))
            return;
    }
    for (int i = 0; i < lists.plane_count(); ++i) {
        at.test(abi::Primitive::plane);
        if (!blocker(lists.plane(i).surface,
                     bits(end.blocked_at(plane_t(lists.plane(i), rays), rays))))
            return;
    }
    if constexpr (F.quadrics)
        for (int i = 0; i < lists.quadric_count(); ++i) {
            at.test(abi::Primitive::quadric);
            if (!but_for_own(record_of<Real>(lists.quadric(i)).surface,
                             quadric_blocks(end, lists.quadric(i), rays, own)))
                return;
        }
    for_each_stiff(lists.stiff(), [&](const auto& stiff) {
        at.test(abi::Primitive::stiff);
        return but_for_own(surface_of(stiff), stiff_blocks(end, stiff, rays, own));
    });
}

/// The lanes of `wanted` that are blocked by anything but their own surface.
template <abi::Features F, class End, class Objects, class Real>
inline std::uint32_t occluded(const End& end, const Objects& objects, const RayPacket<Real>& rays,
                              const vint<Real>& own, std::uint32_t wanted)
{
    std::uint32_t open = wanted;
    visit_blockers<F>(end, objects, rays, own, [&](std::int32_t, std::uint32_t blocked) {
        open &= ~blocked;
        return open != 0;
    });
    return wanted & ~open;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
