#pragma once

#include "kernels/shade/shade_context.hpp"
#include "kernels/stream/probe.hpp"

// Skips rays whose weight is too small, and records an upper bound of the light that their pixels
// lack.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Adds to each ray's pixel an upper bound of the light that the ray could have returned in any
/// channel, rounded up to whole units of abi::lack_unit: sums of whole numbers do not depend on
/// their order.
template <class Real>
[[gnu::noinline]] void record_cut(const abi::MostLight& most_light, double* lacks,
                                  const PathPacket<Real>& path, const Vec3v<Real>& weight,
                                  std::uint32_t cut)
{
    const LaneVectors<Real> weights(weight);
    const LaneIntegers<Real> pixel(path.pixel);
    for (; cut != 0; cut &= cut - 1) {
        const int lane = __builtin_ctz(cut);
        double most = 0.0;
        for (int channel = 0; channel < 3; ++channel) {
            const double light = __builtin_fabs(static_cast<double>(weights.axis[channel][lane])) *
                                 most_light.channel[channel];
            most = light > most ? light : most;
        }
        lacks[pixel.value[lane]] += __builtin_ceil(most / abi::lack_unit);
    }
}

/// The lanes of `active` whose child ray is traced: its weight, `share` times that of the ray, is
/// at least RayRules::min_weight in some channel.
template <abi::Features F, class Real>
inline std::uint32_t heavy_enough(const ShadeContext<F, Real>& context,
                                  const PathPacket<Real>& path, const Vec3v<Real>& share,
                                  std::uint32_t active)
{
    if (context.lacks == nullptr || active == 0)
        return active;
    const Vec3v<Real> weight = path.weight * share;
    const vreal<Real> largest = max(max(weight.x, weight.y), weight.z);
    const std::uint32_t traced =
        active & bits(largest >= vreal<Real>(context.scene->rules.min_weight));
    if (traced != active) {
        context.counts->cut += static_cast<unsigned>(__builtin_popcount(active & ~traced));
        record_cut(context.scene->rules.most_light[context.depth + 1], context.lacks, path, weight,
                   active & ~traced);
    }
    return traced;
}

/// The largest amount that any pixel lacks.
inline double most_lacking(const double* lacks, int pixels)
{
    double most = 0.0;
    for (int pixel = 0; pixel < pixels; ++pixel)
        most = lacks[pixel] > most ? lacks[pixel] : most;
    return most * abi::lack_unit;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
