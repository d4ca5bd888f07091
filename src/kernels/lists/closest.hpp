#pragma once

#include "kernels/lists/object_lists.hpp"
#include "kernels/precision/own_surface.hpp"
#include "kernels/stats/observe.hpp"

// Closest hits of a packet with the objects of lists.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Tests rays against all objects of a scene, or rays that share an origin against the objects of a
/// cone.
template <abi::Features F, class Objects, class Real, class Own>
inline void closest_hit(HitPacket<Real>& hit, const Objects& objects, const RayPacket<Real>& rays,
                        const Own& own)
{
    const TestScope at;
    for_each_kind<F>([&](auto kind) {
        const auto& list = objects_of<decltype(kind)>(objects);
        for (int i = 0; i < list.count; ++i) {
            const auto& object = object_at(list, i);
            if (own.all_on(body_of(object)))
                continue;
            at.test(kind.primitive);
            keep_closest(hit, object, rays, own);
        }
        return true;
    });
}

/// The same with error bounds, for rays from the origins that the bounds are for.
template <abi::Features F, Origin O, class Own>
inline void closest_hit(HitPacket<float>& hit, const FilteredObjects<O>& objects,
                        const RayPacket<float>& rays, const Own& own)
{
    const RayScale scale(rays);
    const TestScope at;
    for_each_kind<F>([&](auto kind) {
        const auto& list = objects_of<decltype(kind)>(objects);
        for (int i = 0; i < list.count; ++i) {
            if constexpr (O == Origin::shared &&
                          requires { rest_is_behind(list, i, hit.t, scale); })
                if (rest_is_behind(list, i, hit.t, scale))
                    break;
            const auto& object = object_at(list, i);
            if (own.all_on(body_of(object)))
                continue;
            at.test(kind.primitive);
            keep_certain<O>(hit, object, rays, scale, own);
        }
        return true;
    });
    if (!objects.certifiable)
        doubt_all(hit, from_bits<float>(all_lanes<float>));
    else
        doubt_all(hit, from_bits<float>(~bits(certifiable(rays)) & all_lanes<float>));
}

/// Calls `visit(valid, t, surface)` for every root of every surface in a scene's lists. Only lanes
/// in `valid` with a finite t are hits.
template <abi::Features F, class Real, class Visit>
inline void visit_all_crossings(const abi::GeometryView<Real>& scene, const RayPacket<Real>& rays,
                                const Visit& visit)
{
    for_each_kind<F>([&](auto kind) {
        const auto& list = kind.list(scene);
        for (int i = 0; i < list.count; ++i) {
            const auto& object = object_at(list, i);
            const std::int32_t first = body_of(object).first;
            visit_crossings(object, rays, [&](vmask<Real> valid, const vreal<Real>& t, int piece) {
                visit(valid, t, first + piece);
            });
        }
        return true;
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
