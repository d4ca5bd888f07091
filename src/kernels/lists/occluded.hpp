#pragma once

#include "kernels/lists/object_lists.hpp"
#include "kernels/precision/own_surface.hpp"
#include "kernels/stats/observe.hpp"

// Which rays of a packet any object occludes before a light.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// `blocked` without the lanes that start on `body`: whether their own object occludes them is
/// known without a test (leave_surface.hpp).
template <class Real>
inline std::uint32_t but_own(std::uint32_t blocked, const OwnSurface<vint<Real>>& own,
                             const Body& body)
{
    return blocked == 0 ? 0 : blocked & own.template lanes_on_others<Real>(body.first, body.pieces);
}

/// The lanes of `certain` that do not start on an object, for expensive tests.
struct CertainOthers {
    const OwnSurface<vint<float>>& own;
    std::uint32_t certain;

    template <class Real>
    std::uint32_t lanes_on_others(std::int32_t first, int pieces = 1) const
    {
        return but_own<float>(certain, own, {first, pieces});
    }
};

/// Calls `occluder(surface, lanes)` for each object with the lanes that it occludes, until that
/// returns false. A lane's own object does not count.
template <abi::Features F, class Objects, class Real, class Occluder>
inline void visit_occluders(const RayEnd<Real>& end, const Objects& objects,
                            const RayPacket<Real>& rays, const OwnSurface<vint<Real>>& own,
                            const Occluder& occluder)
{
    const TestScope at;
    for_each_kind<F>([&](auto kind) {
        const auto& list = objects_of<decltype(kind)>(objects);
        for (int i = 0; i < list.count; ++i) {
            const auto& object = object_at(list, i);
            const Body body = body_of(object);
            if (own.all_on(body))
                continue;
            at.test(kind.primitive);
            const std::uint32_t blocked = occluding_lanes(end, object, rays);
            if (!occluder(body.first, but_own<Real>(blocked, own, body)))
                return false;
        }
        return true;
    });
}

/// Whether lists may be sorted by distance; then the objects behind the ends of all rays are not
/// tested. The lists of a frame's lights are not sorted, and the check would cost a tenth of
/// shading.
enum class Order { any, by_distance };

/// How many objects of a list rays up to t_end are tested against.
template <Order O, class List>
inline int tested_of(const List& list, const vreal<float>& t_end, const RayScale& scale)
{
    if constexpr (O == Order::by_distance && requires { count_before(list, t_end, scale); })
        return count_before(list, t_end, scale);
    else
        return list.count;
}

/// The same with error bounds, up to t_end, for rays from the origins that the bounds are for.
/// Returns the lanes that may be occluded; lanes that certainly are may be among them.
template <abi::Features F, Order O = Order::any, Origin From, class Occluder>
inline std::uint32_t visit_occluders(const vreal<float>& t_end,
                                     const FilteredObjects<From>& objects,
                                     const RayPacket<float>& rays,
                                     const OwnSurface<vint<float>>& own, const Occluder& occluder)
{
    const RayScale scale(rays);
    const std::uint32_t certain = objects.certifiable ? bits(certifiable(rays)) : 0;
    std::uint32_t unsure = ~certain & all_lanes<float>;
    note_in_the_way(unsure, abi::Cause::magnitude);
    // Returns whether to continue.
    const auto take = [&](const Body& body, const Occlusion& occlusion) {
        const std::uint32_t blocked = occlusion.blocked & certain;
        unsure |= but_own<float>(occlusion.unsure, own, body);
        return blocked == 0 || occluder(body.first, but_own<float>(blocked, own, body));
    };
    const CertainOthers others{own, certain};
    const TestScope at;
    for_each_kind<F>([&](auto kind) {
        const auto& list = objects_of<decltype(kind)>(objects);
        const int count = tested_of<O>(list, t_end, scale);
        for (int i = 0; i < count; ++i) {
            const auto& object = object_at(list, i);
            if (own.all_on(body_of(object)))
                continue;
            at.test(kind.primitive);
            if (!take(body_of(object), occludes<From>(object, rays, scale, t_end, others)))
                return false;
        }
        return true;
    });
    return unsure;
}

/// The lanes of `wanted` that any object except their own occludes.
template <abi::Features F, class Objects, class Real>
inline std::uint32_t occluded(const RayEnd<Real>& end, const Objects& objects,
                              const RayPacket<Real>& rays, const OwnSurface<vint<Real>>& own,
                              std::uint32_t wanted)
{
    std::uint32_t open = wanted;
    visit_occluders<F>(end, objects, rays, own, [&](std::int32_t, std::uint32_t blocked) {
        open &= ~blocked;
        return open != 0;
    });
    return wanted & ~open;
}

/// The same with error bounds.
template <abi::Features F, Order O = Order::any, Origin From>
inline Occlusion occluded(const vreal<float>& t_end, const FilteredObjects<From>& objects,
                          const RayPacket<float>& rays, const OwnSurface<vint<float>>& own,
                          std::uint32_t wanted)
{
    std::uint32_t open = wanted;
    const std::uint32_t unsure =
        visit_occluders<F, O>(t_end, objects, rays, own, [&](std::int32_t, std::uint32_t blocked) {
            open &= ~blocked;
            return open != 0;
        });
    return {wanted & ~open, open & unsure};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
