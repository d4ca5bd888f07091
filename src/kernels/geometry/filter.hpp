#pragma once

#include "kernels/geometry/error_bounds.hpp"
#include "kernels/stats/observe.hpp"

// A floating-point filter (Brönnimann, Burnikel and Pion, "Interval arithmetic yields efficient
// dynamic filters", 2001) for the closest hit. Each test returns an interval that contains t, or
// reports that it cannot decide. The search keeps the hit whose interval ends first, and the
// smallest t at which any other hit may be. If these overlap, the ray is unsure and is traced again
// in double (retrace.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Keeps hits that certainly exist, with t in [low, high], in the lanes of `active`.
inline void keep_sure(HitPacket<float>& hit, vmask<float> active, const vreal<float>& low,
                      const vreal<float>& high, std::int32_t surface)
{
    const auto first = active & (high < hit.t);
    const vreal<float> behind = select(first, hit.t_low, low);
    const vint<float> number(lane_int<float>{surface});
    note_rival<float>(active & (behind < hit.other), select(first, hit.surface, number));
    hit.other = select(active & (behind < hit.other), behind, hit.other);
    hit.t = select(first, high, hit.t);
    hit.t_low = select(first, low, hit.t_low);
    hit.surface = select(first, number, hit.surface);
}

/// Records that the lanes of `active` may have a hit at `low` or later. In the lanes of `at_end` it
/// exists but may be before t_min; in the others it may not exist.
inline void keep_doubt(HitPacket<float>& hit, vmask<float> active, const vreal<float>& low,
                       std::uint32_t at_end)
{
    // NaN means that it may be anywhere.
    const vreal<float> from = select(low == low, low, vreal<float>(-__builtin_inff()));
    note_doubt<float>(active & (from < hit.other), at_end);
    hit.other = select(active & (from < hit.other), from, hit.other);
}

/// Makes the lanes of `active` unsure.
inline void doubt_all(HitPacket<float>& hit, vmask<float> active)
{
    note_magnitude<float>(active);
    hit.other = select(active, vreal<float>(-__builtin_inff()), hit.other);
}

/// Lanes whose closest hit is unsure.
inline std::uint32_t unsure_lanes(const HitPacket<float>& hit)
{
    const vreal<float> never(__builtin_inff());
    return bits((hit.other <= hit.t) & (hit.other < never));
}

/// The ends of an interval that contains a t that was rounded once.
inline vreal<float> rounded_low(const vreal<float>& t)
{
    return nmadd(vreal<float>(roundoffs(2.0f)), abs(t), t);
}
inline vreal<float> rounded_high(const vreal<float>& t)
{
    return madd(vreal<float>(roundoffs(2.0f)), abs(t), t);
}

/// The two roots of a surface's equation along the rays, and an upper bound of the error of each.
struct RootIntervals {
    vreal<float> near, far;
    vreal<float> error;
};

/// The first of two roots beyond t_min.
struct FirstRoot {
    vreal<float> low, high;
    vmask<float> counts;  ///< lanes in which the root is certainly beyond t_min
    std::uint32_t none;   ///< lanes in which certainly neither root is
};

inline FirstRoot first_root_beyond(const RootIntervals& roots, const vreal<float>& t_min)
{
    const auto near_behind = roots.near + roots.error < t_min;
    const vreal<float> root = select(near_behind, roots.far, roots.near);
    const vreal<float> low = root - roots.error;
    const vreal<float> high = root + roots.error;
    return {low, high, low > t_min, bits(near_behind) & bits(high < t_min)};
}

/// Keeps the first root beyond t_min in the lanes of `sure`, which certainly hit the surface.
inline void keep_first_of(HitPacket<float>& hit, const RootIntervals& roots, vmask<float> sure,
                          const vreal<float>& t_min, std::int32_t surface)
{
    const FirstRoot first = first_root_beyond(roots, t_min);
    keep_sure(hit, sure & first.counts, first.low, first.high, surface);
    const std::uint32_t open = bits(sure) & ~bits(first.counts) & ~first.none;
    if (open != 0)
        keep_doubt(hit, from_bits<float>(open), first.low, all_lanes<float>);
}

/// The result of tests for occlusion with error bounds.
struct Occlusion {
    std::uint32_t blocked = 0;  ///< lanes that are certainly occluded
    std::uint32_t unsure = 0;   ///< lanes that may be occluded, not among `blocked`
};

/// Whether a root lies between t_min and t_end, in the lanes of `sure`.
inline Occlusion root_between(const RootIntervals& roots, vmask<float> sure,
                              const vreal<float>& t_min, const vreal<float>& t_end)
{
    const vreal<float> from = t_min + roots.error;
    const vreal<float> to = t_end - roots.error;
    const std::uint32_t inside = (bits((roots.near > from) & (roots.near < to)) |
                                  bits((roots.far > from) & (roots.far < to))) &
                                 bits(sure);
    const std::uint32_t open = bits(sure) & ~inside;
    if (open == 0)
        return {inside, 0};
    const vreal<float> before = t_min - roots.error;
    const vreal<float> behind = t_end + roots.error;
    const std::uint32_t outside = (bits(roots.near < before) | bits(roots.near > behind)) &
                                  (bits(roots.far < before) | bits(roots.far > behind));
    note_in_the_way(open & ~outside, abi::Cause::range);
    return {inside, open & ~outside};
}

/// The same for a single root in [low, high].
inline Occlusion root_between(const vreal<float>& low, const vreal<float>& high,
                              std::uint32_t active, const vreal<float>& t_min,
                              const vreal<float>& t_end)
{
    const std::uint32_t inside = bits((low > t_min) & (high < t_end));
    const std::uint32_t outside = bits(high < t_min) | bits(low > t_end);
    note_in_the_way(active & ~inside & ~outside, abi::Cause::range);
    return {active & inside, active & ~inside & ~outside};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
