#pragma once

#include "kernels/group_closest.hpp"
#include "kernels/tile_memory.hpp"

// What the closest-hit search says of the surface a ray starts on is put right here, lane by
// lane, after the search: second_meeting.hpp knows better.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where a packet of rays started, as StartArrays holds it. A `surface` of -1 is none.
template <class Real>
struct StartPacket {
    Vec3v<Real> point;
    vint<Real> surface;
    vreal<Real> second;
};

template <abi::Features F, class Real>
inline StartPacket<Real> load_start(const StartArrays<F, Real>& starts, int first)
{
    return {load3(starts.point, first), load(starts.surface + first), load(starts.second + first)};
}

/// The closest hits of the lanes of `active` between t_min and t_max, by a search of its own:
/// rare.
template <abi::Features F, class Real>
[[gnu::noinline]] HitPacket<Real> search_again(const abi::SceneView<Real>& scene,
                                               const RayPacket<Real>& rays,
                                               const vreal<Real>& t_max, std::uint32_t active)
{
    RayGroup<Real> group;
    for (std::uint16_t& cell : group.active)
        cell = 0;
    store_rays(group, 0, rays);
    start_rays(group, 0, t_max, active);
    end_group(group, lanes<Real>);
    closest_of_group<F>(scene, scene, group);
    return load_hits(group, 0);
}

/// Lanes of `own`, whose search ended at their own surface, where that is the place they start at
/// and not their second meeting: nearer to the one than to the other.
template <class Real>
inline std::uint32_t taken_for_hits(const HitPacket<Real>& hit, const StartPacket<Real>& start,
                                    std::uint32_t active)
{
    const auto own = int_equal(hit.surface, start.surface);
    return bits(own) & active & ~bits(hit.t + hit.t > start.second);
}

/// Puts right what the lanes of `active` hit, and where those start from that meet their own
/// surface again: at the surface, not a little off it.
template <abi::Features F, class Real>
inline void settle_start(const abi::SceneView<Real>& scene, RayPacket<Real>& rays,
                         HitPacket<Real>& hit, const StartPacket<Real>& start,
                         const vreal<Real>& t_max, std::uint32_t active)
{
    active &= ~bits(int_equal(start.surface, vint<Real>(lane_int<Real>(-1))));
    // A surface has no more than two places to be taken for a hit.
    std::uint32_t taken = taken_for_hits(hit, start, active);
    for (; taken != 0; taken = taken_for_hits(hit, start, taken)) {
        RayPacket<Real> beyond = rays;
        beyond.t_min = hit.t;
        const HitPacket<Real> next =
            search_again<abi::tree_features(F)>(scene, beyond, t_max, taken);
        hit.t = select(from_bits<Real>(taken), next.t, hit.t);
        hit.surface = select(from_bits<Real>(taken), next.surface, hit.surface);
    }
    const vreal<Real> never(static_cast<Real>(__builtin_inf()));
    const auto own = either(int_equal(hit.surface, start.surface), start.second < hit.t);
    const auto again = own & (start.second < never) & from_bits<Real>(active);
    if (none(again))
        return;
    hit.t = select(again, start.second, hit.t);
    hit.surface = select(again, start.surface, hit.surface);
    rays.org = select(again, start.point, rays.org);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
