#pragma once

#include "kernels/traverse/bvh_closest.hpp"
#include "kernels/traverse/retrace.hpp"

// Unsure closest hits, found in double.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The upper end of the interval that a search in single precision would have: refining begins
/// there, whoever found the hit.
inline float found_at(double t)
{
    const float rounded = static_cast<float>(t);
    return madd(roundoffs(2.0f), rounded < 0 ? -rounded : rounded, rounded);
}

/// Finds their closest hits in double, and calls `take(ray, t, surface)` for each.
template <abi::Features F, class Take>
inline void find_wide(const abi::GeometryView<double>& wide, WideBundle& bundle, const Take& take)
{
    const RetraceScope retracing;
    end_bundle(bundle.rays, bundle.count);
    if constexpr (F.probe)
        if (asks_for_undecided())
            count_undecided_of(bundle.rays, bundle,
                               [&](RayBundle<double>& rays, std::uint64_t* surface) {
                                   closest_of_bundle<wide_features<F>>(wide, wide, rays);
                                   for (int i = 0; i < bundle.count; ++i)
                                       surface[i] = static_cast<std::uint64_t>(rays.surface[i]);
                               });
    closest_of_bundle<wide_features<F>>(wide, wide, bundle.rays);
    for (int i = 0; i < bundle.count; ++i)
        take(bundle.from[i], found_at(bundle.rays.t[i]),
             static_cast<std::int32_t>(bundle.rays.surface[i]));
}

/// The closest hits of the lanes of `unsure`, by double.
template <abi::Features F>
[[gnu::noinline]] void retrace_packet(const abi::SceneView<float>& scene,
                                      const RayPacket<float>& rays, HitPacket<float>& hit,
                                      const StartPacket<float>& start, const vreal<float>& t_max,
                                      std::uint32_t unsure)
{
    alignas(64) float t[lanes<float>];
    alignas(64) std::int32_t surface[lanes<float>];
    store(t, hit.t);
    store(surface, hit.surface);
    count_unsure_lanes(unsure, surface, [&](std::int32_t number) {
        return scene.materials.of_surface[number].object;
    });
    WideBundle bundle;
    add_lanes(bundle, 0, rays, start, t_max, unsure);
    find_wide<F>(*scene.wide, bundle, [&](int lane, float closest, std::int32_t number) {
        t[lane] = closest;
        surface[lane] = number;
    });
    hit.t = load(t);
    hit.surface = load(surface);
}

/// Puts right what a packet hit where it is unsure; counts those lanes.
template <abi::Features F, class Real>
inline std::uint32_t settle_packet(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                                   HitPacket<Real>& hit, const StartPacket<Real>& start,
                                   const vreal<Real>& t_max, std::uint32_t active)
{
    if constexpr (F.exact) {
        const std::uint32_t unsure = unsure_lanes(hit) & active;
        if (unsure != 0)
            retrace_packet<F>(scene, rays, hit, start, t_max, unsure);
        return unsure;
    } else {
        return 0;
    }
}

/// The closest hits of the rays of `unsure` of a bundle, by double; returns their number.
template <abi::Features F, class StartOf, class EndOf>
[[gnu::noinline]] int retrace_bundle(const abi::SceneView<float>& scene, RayBundle<float>& bundle,
                                     const std::uint16_t (&unsure)[bundle_cells],
                                     const StartOf& start_of, const EndOf& t_max_of)
{
    WideBundle again;
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t lanes_of =
            unsure[first / cell_rays] >> first % cell_rays & all_lanes<float>;
        if (lanes_of != 0)
            add_lanes(again, first, load_rays(bundle, first), start_of(first), t_max_of(first),
                      lanes_of);
    }
    for (int i = 0; i < again.count; ++i)
        count_unsure_ray(again.from[i], bundle.surface[again.from[i]], [&](std::int32_t number) {
            return scene.materials.of_surface[number].object;
        });
    find_wide<F>(*scene.wide, again, [&](int ray, float t, std::int32_t surface) {
        bundle.t[ray] = t;
        bundle.surface[ray] = surface;
    });
    return again.count;
}

/// The same of a bundle. `start_of(first)` tells where the rays of a packet start,
/// `t_max_of(first)` where they end.
template <abi::Features F, class Real, class StartOf, class EndOf>
inline int settle_bundle(const abi::SceneView<Real>& scene, RayBundle<Real>& bundle,
                         const StartOf& start_of, const EndOf& t_max_of)
{
    if constexpr (F.exact) {
        std::uint16_t unsure[bundle_cells];
        std::uint32_t any_unsure = 0;
        for (int first = 0; first < bundle_rays; first += lanes<Real>) {
            std::uint16_t& cell = unsure[first / cell_rays];
            if (first % cell_rays == 0)
                cell = 0;
            const std::uint32_t active = active_lanes(bundle, first);
            if (active == 0)
                continue;
            const std::uint32_t lanes_of = unsure_lanes(load_hits(bundle, first)) & active;
            cell = static_cast<std::uint16_t>(cell | lanes_of << first % cell_rays);
            any_unsure |= lanes_of;
        }
        return any_unsure == 0 ? 0 : retrace_bundle<F>(scene, bundle, unsure, start_of, t_max_of);
    } else {
        return 0;
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
