#pragma once

#include "kernels/bvh/bvh_occluded.hpp"
#include "kernels/retrace/retrace_occluded.hpp"
#include "kernels/stream/ray_chunks.hpp"

// Whether rays from the caller are occluded.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F, class Objects, class Real>
[[gnu::noinline]] void occluded_chunk_in_lists(const abi::SceneView<Real>& scene,
                                               const Objects& objects,
                                               const abi::RaysView<Real>& view, int begin, int end,
                                               std::uint8_t* mask)
{
    for (int first = begin; first < end; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        // A NaN anywhere else in a ray makes all its comparisons fail; a NaN as its end alone would
        // not.
        const std::uint32_t wanted =
            first_lanes<Real>(packet.count) & bits(packet.t_max == packet.t_max);
        const OwnSurface<vint<Real>> own{no_surface<Real>()};
        std::uint32_t blocked = 0;
        if constexpr (F.exact) {
            const Occlusion occlusion =
                occluded<F, Order::by_distance>(packet.t_max, objects, packet.rays, own, wanted);
            blocked = occlusion.blocked;
            if (occlusion.unsure != 0)
                blocked |=
                    retrace_occluded<F.probe>(*scene.wide, packet.rays, own.surface, packet.t_max,
                                              RayInterval::open, occlusion.unsure);
        } else {
            blocked = occluded<F>(RayEnd<Real>{packet.t_max, RayInterval::open}, objects,
                                  packet.rays, own, wanted);
        }
        store_mask<Real>(mask + first, blocked & wanted, packet.count);
    }
}

/// Decides the unsure rays of a bundle in double, and ends those that are occluded. Rays end at the
/// bundle's `t`; their `interval` is open or closed (RayEnd).
template <abi::Features F>
[[gnu::noinline]] void decide_occluded(const abi::SceneView<float>& scene, RayBundle<float>& bundle,
                                       RayInterval interval)
{
    WideBundle wide;
    add_unsure_segments(wide, bundle, [](int, std::uint32_t) {});
    if (wide.count == 0)
        return;
    block_wide<F.probe>(*scene.wide, wide, interval, Occluders::any, [&](int ray, std::int32_t) {
        const int first = ray / lanes<float> * lanes<float>;
        finish_lanes(bundle, first, 1u << (ray - first));
        return true;
    });
}

template <abi::Features F, class Real>
[[gnu::noinline]] void occluded_chunk_in_bvh(const abi::SceneView<Real>& scene,
                                             const StreamWork<F, Real>& work,
                                             const abi::RaysView<Real>& view, int begin, int end,
                                             std::uint8_t* mask)
{
    RayBundle<Real>& bundle = *work.bundle;
    const int count = end - begin;
    for (int first = 0; first < count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, begin + first);
        start_segments<F>(bundle, first, packet.rays, packet.t_max, no_surface<Real>(),
                          first_lanes<Real>(count - first) & numbers(packet));
    }
    end_bundle(bundle, count);
    std::uint16_t wanted[bundle_cells];
    for (int cell = 0; cell < bundle_cells; ++cell)
        wanted[cell] = bundle.active[cell];
    visit_occluders_of_bundle<F>(scene, work.nearby, bundle, RayInterval::open, Occluder());
    if constexpr (F.exact)
        decide_occluded<F>(scene, bundle, RayInterval::open);
    for (int first = 0; first < count; first += lanes<Real>) {
        const std::uint32_t before = wanted[first / cell_rays] >> first % cell_rays;
        store_mask<Real>(mask + begin + first, before & ~active_lanes(bundle, first),
                         count - first);
    }
}

template <abi::Features F, class Real>
inline void occluded_rays(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                          std::uint8_t* mask, void* scratch)
{
    StreamWork<F, Real> work(scratch, scene);
    for_each_chunk(work, scene, view, [&](int begin, int end) {
        if (!work.by_lists)
            occluded_chunk_in_bvh(scene, work, view, begin, end, mask);
        else if (work.shares_origin)
            occluded_chunk_in_lists<F>(scene, work.from_point, view, begin, end, mask);
        else
            occluded_chunk_in_lists<F>(scene, work.nearby, view, begin, end, mask);
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
