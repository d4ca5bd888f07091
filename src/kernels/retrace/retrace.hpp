#pragma once

#include "kernels/bvh/bundle.hpp"
#include "kernels/precision/met_again.hpp"

#include <limits>

// Traces rays in single precision that are unsure of their hit again in double, together however
// few they are. Their hits are then refined as all others (refine.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

inline void count_unsure(abi::RayCounts& counts, std::uint32_t unsure)
{
    counts.unsure += static_cast<unsigned>(__builtin_popcount(unsure));
}

/// The features of the kernels that trace rays again. Such rays are few, so one feature set
/// suffices.
inline constexpr abi::Features wide_features{.quadrics = true};

/// Rays of a bundle of floats, in a bundle of doubles.
struct WideBundle {
    RayBundle<double> rays;
    MetAgain again[bundle_rays];
    std::uint8_t from[bundle_rays];  ///< their numbers in the bundle of floats
    int count = 0;

    WideBundle()
    {
        for (std::uint16_t& cell : rays.active)
            cell = 0;
    }

    /// Adds a ray. Other surfaces are searched for up to slightly beyond the hit with the ray's own
    /// object.
    void add(int ray, const float (&org)[3], const float (&dir)[3], float t_min, float t_max,
             const MetAgain& met, std::int32_t own)
    {
        for (int axis = 0; axis < 3; ++axis) {
            rays.org[axis][count] = org[axis];
            rays.dir[axis][count] = dir[axis];
        }
        rays.t_min[count] = t_min;
        // A hit whose t overflows single precision is no hit.
        constexpr float largest = std::numeric_limits<float>::max();
        const double t_end = t_max < largest ? t_max : largest;
        const double little_beyond =
            met.t + near_own_hit(nearly_met<float>, met, {dir[0], dir[1], dir[2]});
        rays.t[count] = little_beyond < t_end ? little_beyond : t_end;
        rays.surface[count] = -1;
        again[count] = met;
        if (!(met.t < t_max))
            again[count].t = __builtin_inf();
        rays.own[count] = own;
        rays.t_low[count] = rays.other[count] = __builtin_inf();
        rays.active[count / cell_rays] |= static_cast<std::uint16_t>(1u << count % cell_rays);
        from[count++] = static_cast<std::uint8_t>(ray);
    }
};

/// Adds the lanes of `unsure` of a packet; the packet's first ray has the number `first`.
inline void add_lanes(WideBundle& bundle, int first, const RayPacket<float>& rays,
                      const StartPacket<float>& start, const vreal<float>& t_max,
                      std::uint32_t unsure)
{
    alignas(64) float value[12][lanes<float>];
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
    store(value[9], start.point.x);
    store(value[10], start.point.y);
    store(value[11], start.point.z);
    store(own, start.surface);
    store(met_again, start.second.surface);
    for (; unsure != 0; unsure &= unsure - 1) {
        const int lane = __builtin_ctz(unsure);
        const MetAgain again{
            {value[9][lane], value[10][lane], value[11][lane]}, value[8][lane], met_again[lane]};
        bundle.add(first + lane, {value[0][lane], value[1][lane], value[2][lane]},
                   {value[3][lane], value[4][lane], value[5][lane]}, value[6][lane], value[7][lane],
                   again, own[lane]);
    }
}

/// How far rays are perturbed to find out whether double can decide them: each number of a ray by
/// four roundoffs of double, up or down.
inline constexpr double double_band = 0x1p-51;

/// Perturbs rays by one of eight sign patterns. For any two of a ray's six numbers, every pair of
/// signs occurs in equally many patterns.
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

/// Counts the rays of a bundle whose `answers(rays, answer)` change when the rays are perturbed.
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

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
