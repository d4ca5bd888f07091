#pragma once

#include "kernels/precision/leave_surface.hpp"
#include "kernels/traverse/bvh_closest.hpp"
#include "kernels/traverse/bvh_occluded.hpp"

// Rays in single precision that are unsure of their hit, traced again in double, together however
// few they are. Their places are found afterwards as those of all others (refine.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

inline void count_unsure(abi::RayCounts& counts, std::uint32_t unsure)
{
    counts.unsure += static_cast<unsigned>(__builtin_popcount(unsure));
}

/// The features of the kernels that rays are traced again by.
template <abi::Features F>
inline constexpr abi::Features wide_features{.quadrics = F.quadrics};

/// Rays of a bundle of floats as a bundle of doubles.
struct WideBundle {
    RayBundle<double> rays;
    std::uint8_t from[bundle_rays];  ///< their numbers in the bundle of floats
    int count = 0;

    WideBundle()
    {
        for (std::uint16_t& cell : rays.active)
            cell = 0;
    }

    /// `t` and `surface` are what the search begins with.
    void add(int ray, const float (&org)[3], const float (&dir)[3], float t_min, float t,
             std::int32_t surface, std::int32_t own)
    {
        for (int axis = 0; axis < 3; ++axis) {
            rays.org[axis][count] = org[axis];
            rays.dir[axis][count] = dir[axis];
        }
        rays.t_min[count] = t_min;
        rays.t[count] = t;
        rays.surface[count] = surface;
        rays.own[count] = own;
        rays.t_low[count] = rays.other[count] = __builtin_inf();
        rays.active[count / cell_rays] |= static_cast<std::uint16_t>(1u << count % cell_rays);
        from[count++] = static_cast<std::uint8_t>(ray);
    }
};

/// Adds the lanes of `unsure` of a packet, whose first ray has the number `first`.
inline void add_lanes(WideBundle& bundle, int first, const RayPacket<float>& rays,
                      const StartPacket<float>& start, const vreal<float>& t_max,
                      std::uint32_t unsure)
{
    alignas(64) float value[9][lanes<float>];
    alignas(64) std::int32_t own[lanes<float>];
    alignas(64) std::int32_t met_again[lanes<float>];
    store(value[0], rays.org.x);
    store(value[1], rays.org.y);
    store(value[2], rays.org.z);
    store(value[3], rays.dir.x);
    store(value[4], rays.dir.y);
    store(value[5], rays.dir.z);
    store(value[6], rays.t_min);
    store(value[7], t_max);
    store(value[8], start.second.t);
    store(own, start.surface);
    store(met_again, start.second.surface);
    for (; unsure != 0; unsure &= unsure - 1) {
        const int lane = __builtin_ctz(unsure);
        const bool again = value[8][lane] < value[7][lane];
        bundle.add(first + lane, {value[0][lane], value[1][lane], value[2][lane]},
                   {value[3][lane], value[4][lane], value[5][lane]}, value[6][lane],
                   again ? value[8][lane] : value[7][lane], again ? met_again[lane] : -1,
                   own[lane]);
    }
}

/// How far a ray is moved to see whether double decides about it: each of its numbers by four of
/// double's roundoffs, up or down.
inline constexpr double double_band = 0x1p-51;

/// Moves rays along one of eight patterns of signs, which have every pair of signs of every two of
/// the six numbers equally often.
inline void move_rays(RayBundle<double>& rays, int count, int pattern)
{
    const int bit[3] = {pattern & 1, pattern >> 1 & 1, pattern >> 2 & 1};
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3;
        const double of_org = bit[axis] != 0 ? 1 + double_band : 1 - double_band;
        const double of_dir = (bit[axis] ^ bit[next]) != 0 ? 1 + double_band : 1 - double_band;
        for (int i = 0; i < count; ++i) {
            rays.org[axis][i] *= of_org;
            rays.dir[axis][i] *= of_dir;
        }
    }
}

/// Counts the rays of a bundle whose `answers(rays, answer)` change when the rays are moved so.
template <class Answers>
inline void count_undecided_of(const RayBundle<double>& rays, const WideBundle& bundle,
                               const Answers& answers)
{
    std::uint64_t still[bundle_rays];
    RayBundle<double> copy = rays;
    answers(copy, still);
    bool changes[bundle_rays] = {};
    for (int pattern = 0; pattern < 8; ++pattern) {
        std::uint64_t moved[bundle_rays];
        copy = rays;
        move_rays(copy, bundle.count, pattern);
        end_bundle(copy, bundle.count);
        answers(copy, moved);
        for (int i = 0; i < bundle.count; ++i)
            changes[i] = changes[i] || moved[i] != still[i];
    }
    for (int i = 0; i < bundle.count; ++i)
        if (changes[i])
            count_undecided(bundle.from[i]);
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
        take(bundle.from[i], static_cast<float>(bundle.rays.t[i]),
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
    count_unsure_lanes(unsure, surface,
                       [&](std::int32_t number) { return scene.material_index[number].object; });
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
        count_unsure_ray(again.from[i], bundle.surface[again.from[i]],
                         [&](std::int32_t number) { return scene.material_index[number].object; });
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

/// Whether it matters what is in the way of a ray, or only that something is.
enum class Occluders { any, all };

/// Counts the rays of which double does not tell what is in their way.
template <abi::Features F>
inline void count_undecided_shadows(const abi::GeometryView<double>& wide, const WideBundle& bundle,
                                    bool closed, Occluders which)
{
    count_undecided_of(bundle.rays, bundle, [&](RayBundle<double>& rays, std::uint64_t* found) {
        for (int i = 0; i < bundle.count; ++i)
            found[i] = 0;
        visit_occluders_of_bundle<wide_features<F>>(
            wide, wide, rays, closed, [&](std::int32_t surface, int first, std::uint32_t lanes_of) {
                // A sum that hardly any two sets of surfaces share.
                const std::uint64_t of_surface =
                    (static_cast<std::uint64_t>(surface) + 1) * 0x9e3779b97f4a7c15u;
                for (std::uint32_t left = lanes_of; left != 0; left &= left - 1)
                    found[first + __builtin_ctz(left)] += which == Occluders::all ? of_surface : 1;
                return which == Occluders::all ? 0 : lanes_of;
            });
    });
}

/// What is in the way of rays up to their end, in double: calls `blocked(ray, surface)` for each
/// object until it returns true.
template <abi::Features F, class Blocked>
inline void block_wide(const abi::GeometryView<double>& wide, WideBundle& bundle, bool closed,
                       [[maybe_unused]] Occluders which, const Blocked& blocked)
{
    const RetraceScope retracing;
    end_bundle(bundle.rays, bundle.count);
    if constexpr (F.probe)
        if (asks_for_undecided())
            count_undecided_shadows<F>(wide, bundle, closed, which);
    visit_occluders_of_bundle<wide_features<F>>(
        wide, wide, bundle.rays, closed,
        [&](std::int32_t surface, int first, std::uint32_t lanes_of) {
            std::uint32_t done = 0;
            for (; lanes_of != 0; lanes_of &= lanes_of - 1) {
                const int lane = __builtin_ctz(lanes_of);
                done |= blocked(int{bundle.from[first + lane]}, surface) ? 1u << lane : 0;
            }
            return done;
        });
}

/// Adds the lanes of `unsure` of a packet of rays that end at t_end.
inline void add_segments(WideBundle& bundle, int first, const RayPacket<float>& rays,
                         const vint<float>& own, const vreal<float>& t_end, std::uint32_t unsure)
{
    StartPacket<float> start = no_start<float>();
    start.surface = own;
    add_lanes(bundle, first, rays, start, t_end, unsure);
}

/// The lanes of `unsure` that are blocked, by double.
template <abi::Features F>
[[gnu::noinline]] std::uint32_t retrace_occluded(const abi::GeometryView<double>& wide,
                                                 const RayPacket<float>& rays,
                                                 const vint<float>& own, const vreal<float>& t_end,
                                                 bool closed, std::uint32_t unsure)
{
    WideBundle bundle;
    add_segments(bundle, 0, rays, own, t_end, unsure);
    std::uint32_t lanes_blocked = 0;
    block_wide<F>(wide, bundle, closed, Occluders::any, [&](int lane, std::int32_t) {
        lanes_blocked |= 1u << lane;
        return true;
    });
    return lanes_blocked;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
