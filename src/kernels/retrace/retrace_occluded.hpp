#pragma once

#include "kernels/bvh/bvh_occluded.hpp"
#include "kernels/retrace/retrace.hpp"

// Decides unsure occlusion in double.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Whether all occluders of a ray are needed, or only whether there is any.
enum class Occluders { any, all };

/// Counts the rays whose occluders double cannot decide.
inline void count_undecided_shadows(const abi::GeometryView<double>& wide, const WideBundle& bundle,
                                    RayInterval interval, Occluders which)
{
    count_undecided_of(bundle.rays, bundle, [&](RayBundle<double>& rays, std::uint64_t* found) {
        for (int i = 0; i < bundle.count; ++i)
            found[i] = 0;
        const auto occluder = [&](std::int32_t surface, int first, std::uint32_t lanes_of) {
            // Two sets of surfaces hardly ever have the same sum of these values.
            const std::uint64_t of_surface =
                (static_cast<std::uint64_t>(surface) + 1) * 0x9e3779b97f4a7c15u;
            for (std::uint32_t left = lanes_of; left != 0; left &= left - 1)
                found[first + __builtin_ctz(left)] += which == Occluders::all ? of_surface : 1;
            return which == Occluders::all ? 0 : lanes_of;
        };
        visit_occluders_of_bundle<wide_features>(wide, wide, rays, interval, Occluder(occluder));
    });
}

/// Finds the occluders of rays up to their ends, in double. Calls `blocked(ray, surface)` for each
/// until it returns true.
template <bool Probe, class Blocked>
inline void block_wide(const abi::GeometryView<double>& wide, WideBundle& bundle,
                       RayInterval interval, [[maybe_unused]] Occluders which,
                       const Blocked& blocked)
{
    const RetraceScope retracing;
    end_bundle(bundle.rays, bundle.count);
    if constexpr (Probe)
        if (asks_for_undecided())
            count_undecided_shadows(wide, bundle, interval, which);
    const auto occluder = [&](std::int32_t surface, int first, std::uint32_t lanes_of) {
        std::uint32_t done = 0;
        for (; lanes_of != 0; lanes_of &= lanes_of - 1) {
            const int lane = __builtin_ctz(lanes_of);
            done |= blocked(int{bundle.from[first + lane]}, surface) ? 1u << lane : 0;
        }
        return done;
    };
    visit_occluders_of_bundle<wide_features>(wide, wide, bundle.rays, interval, Occluder(occluder));
}

/// Adds the lanes of `unsure` of a packet of rays that end at t_end.
inline void add_segments(WideBundle& bundle, int first, const RayPacket<float>& rays,
                         const vint<float>& own, const vreal<float>& t_end, std::uint32_t unsure)
{
    StartPacket<float> start = no_start<float>();
    start.surface = own;
    add_lanes(bundle, first, rays, start, t_end, unsure);
}

/// Adds the active rays of a bundle that may be occluded, and calls `each(first, lanes)` with those
/// of every packet.
template <class Each>
inline void add_unsure_segments(WideBundle& wide, const RayBundle<float>& bundle, const Each& each)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t unsure = unsure_of(bundle, first) & active_lanes(bundle, first);
        if (unsure == 0)
            continue;
        add_segments(wide, first, load_rays(bundle, first), load(bundle.own + first),
                     load(bundle.t + first), unsure);
        each(first, unsure);
    }
}

/// The lanes of `unsure` that are occluded, decided in double.
template <bool Probe>
[[gnu::noinline]] std::uint32_t retrace_occluded(const abi::GeometryView<double>& wide,
                                                 const RayPacket<float>& rays,
                                                 const vint<float>& own, const vreal<float>& t_end,
                                                 RayInterval interval, std::uint32_t unsure)
{
    WideBundle bundle;
    add_segments(bundle, 0, rays, own, t_end, unsure);
    std::uint32_t lanes_blocked = 0;
    block_wide<Probe>(wide, bundle, interval, Occluders::any, [&](int lane, std::int32_t) {
        lanes_blocked |= 1u << lane;
        return true;
    });
    return lanes_blocked;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
