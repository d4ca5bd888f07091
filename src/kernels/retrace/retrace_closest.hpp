#pragma once

#include "kernels/bvh/bvh_closest.hpp"
#include "kernels/retrace/retrace.hpp"

// Finds unsure closest hits in double.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The t that a search in single precision would have stored, the upper end of its interval.
/// Refining starts from it, whichever search found the hit.
inline float found_at(double t)
{
    const float rounded = static_cast<float>(t);
    return madd(roundoffs(2.0f), rounded < 0 ? -rounded : rounded, rounded);
}

/// Finds the closest hits of rays in double.
inline void find_closest(const abi::SceneView<float>& scene, const WideBundle& bundle,
                         RayBundle<double>& rays)
{
    closest_of_bundle<wide_features>(*scene.wide, *scene.wide, rays);
    for (int ray = 0; ray < bundle.count; ++ray) {
        const MetAgain& again = bundle.again[ray];
        if (again.t < __builtin_inf() &&
            meets_own_first<float>(scene.shapes, again,
                                   {rays.dir[0][ray], rays.dir[1][ray], rays.dir[2][ray]},
                                   rays.t[ray], rays.surface[ray])) {
            rays.t[ray] = again.t;
            rays.surface[ray] = again.surface;
        }
    }
}

/// Finds the closest hits of a bundle, and writes them to `t` and `surface` of the rays that it was
/// made from.
template <bool Probe>
[[gnu::noinline]] void find_wide(const abi::SceneView<float>& scene, WideBundle& bundle, float* t,
                                 std::int32_t* surface)
{
    const RetraceScope retracing;
    end_bundle(bundle.rays, bundle.count);
    if constexpr (Probe)
        if (asks_for_undecided())
            count_undecided_of(bundle.rays, bundle,
                               [&](RayBundle<double>& rays, std::uint64_t* found) {
                                   find_closest(scene, bundle, rays);
                                   for (int i = 0; i < bundle.count; ++i)
                                       found[i] = static_cast<std::uint64_t>(rays.surface[i]);
                               });
    find_closest(scene, bundle, bundle.rays);
    for (int i = 0; i < bundle.count; ++i) {
        t[bundle.from[i]] = found_at(bundle.rays.t[i]);
        surface[bundle.from[i]] = static_cast<std::int32_t>(bundle.rays.surface[i]);
    }
}

/// Finds the closest hits of the lanes of `unsure` in double.
template <bool Probe>
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
    find_wide<Probe>(scene, bundle, t, surface);
    hit.t = load(t);
    hit.surface = load(surface);
}

/// Corrects the hits of packets in double whose rays hit their own object again close to the hit.
inline void correct_met_again(const abi::ShapesView& shapes, const RayPacket<double>& rays,
                              HitPacket<double>& hit, const StartPacket<double>& start,
                              const vreal<double>& t_max, std::uint32_t active)
{
    const std::uint32_t again = bits(start.second.t < t_max) & active;
    if (again == 0)
        return;
    const std::uint32_t own = again & bits(int_equal(hit.surface, start.second.surface));
    const vreal<double> near =
        near_own_hit(nearly_met<double>, start.second.t, start.point, rays.dir2);
    std::uint32_t open = again & ~own & bits(abs(hit.t - start.second.t) <= near);
    std::uint32_t by_own = own;
    if (open != 0) {
        const LaneVectors<double> from(start.point);
        const LaneVectors<double> dir(rays.dir);
        alignas(64) double t[2][lanes<double>];
        alignas(64) std::int64_t surface[2][lanes<double>];
        store(t[0], hit.t);
        store(t[1], start.second.t);
        store(surface[0], hit.surface);
        store(surface[1], start.second.surface);
        for (; open != 0; open &= open - 1) {
            const int lane = __builtin_ctz(open);
            const MetAgain met{{from.axis[0][lane], from.axis[1][lane], from.axis[2][lane]},
                               t[1][lane],
                               static_cast<std::int32_t>(surface[1][lane])};
            if (meets_own_first<double>(shapes, met,
                                        {dir.axis[0][lane], dir.axis[1][lane], dir.axis[2][lane]},
                                        t[0][lane], surface[0][lane]))
                by_own |= 1u << lane;
        }
    }
    const vmask<double> keeps = from_bits<double>(by_own);
    hit.t = select(keeps, start.second.t, hit.t);
    hit.surface = select(keeps, start.second.surface, hit.surface);
}

/// Corrects the unsure hits of a packet; returns the unsure lanes.
template <abi::Features F, class Real>
inline std::uint32_t correct_packet(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                                    HitPacket<Real>& hit, const StartPacket<Real>& start,
                                    const vreal<Real>& t_max, std::uint32_t active)
{
    if constexpr (F.exact) {
        const std::uint32_t unsure = unsure_lanes(hit) & active;
        if (unsure != 0)
            retrace_packet<F.probe>(scene, rays, hit, start, t_max, unsure);
        return unsure;
    } else if constexpr (sizeof(Real) == sizeof(double)) {
        correct_met_again(scene.shapes, rays, hit, start, t_max, active);
    }
    return 0;
}

/// Finds the closest hits of the rays of `unsure` of a bundle in double; returns the number of
/// these rays.
template <bool Probe, class StartOf, class EndOf>
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
    find_wide<Probe>(scene, again, bundle.t, bundle.surface);
    return again.count;
}

/// Finds the unsure closest hits of a bundle; returns whether there are any.
inline bool find_unsure(std::uint16_t (&unsure)[bundle_cells], const RayBundle<float>& bundle)
{
    std::uint32_t any_unsure = 0;
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
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
    return any_unsure != 0;
}

/// correct_met_again() for the packets of a bundle.
template <class StartOf, class EndOf>
inline void correct_bundle_met_again(const abi::ShapesView& shapes, RayBundle<double>& bundle,
                                     const StartOf& start_of, const EndOf& t_max_of)
{
    for (int first = 0; first < bundle_rays; first += lanes<double>) {
        const std::uint32_t active = active_lanes(bundle, first);
        // Beyond the end of a stream a packet has no ray, and its end must not be read.
        if (active == 0)
            continue;
        const StartPacket<double> start = start_of(first);
        const vreal<double> t_max = t_max_of(first);
        if ((bits(start.second.t < t_max) & active) == 0)
            continue;
        HitPacket<double> hit = load_hits(bundle, first);
        correct_met_again(shapes, load_rays(bundle, first), hit, start, t_max, active);
        store(bundle.t + first, hit.t);
        store(bundle.surface + first, hit.surface);
    }
}

/// Corrects the hits of a bundle; returns the number of unsure ones. `start_of(first)` is the start
/// of a packet's rays, `t_max_of(first)` their end.
template <abi::Features F, class Real, class StartOf, class EndOf>
inline int correct_bundle(const abi::SceneView<Real>& scene, RayBundle<Real>& bundle,
                          const StartOf& start_of, const EndOf& t_max_of)
{
    if constexpr (F.exact) {
        std::uint16_t unsure[bundle_cells];
        if (find_unsure(unsure, bundle))
            return retrace_bundle<F.probe>(scene, bundle, unsure, start_of, t_max_of);
    } else if constexpr (sizeof(Real) == sizeof(double)) {
        correct_bundle_met_again(scene.shapes, bundle, start_of, t_max_of);
    }
    return 0;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
