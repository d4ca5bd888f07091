#pragma once

#include "kernels/precision/refine.hpp"

// Rays that meet their own body again where another surface is.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where a ray meets the body again that it starts on (leave_surface.hpp).
struct MetAgain {
    double start[3];
    double t;  ///< infinite for nowhere
    std::int32_t surface;
};

/// The share of a t within which double can't tell two surfaces apart that lie in one place.
inline constexpr double one_place = 0x1p-44;

/// Whether a ray that meets its own body again meets that before the hit at `t` on `surface`, which
/// is negative for none. Near each other both are looked for once more from the place where the ray
/// starts: for the search that is lifted off its surface, and the t was rounded. Where they lie in
/// one place, as a glass's foot and the table do, the surface of the lower number is hit.
inline bool meets_own_first(const abi::ShapesView& shapes, const MetAgain& again,
                            const double (&dir)[3], double t, std::int64_t surface)
{
    if (surface < 0)
        return true;
    const double difference = t - again.t;
    constexpr double near = nearly_met<float>;
    if (!(magnitude(difference) <= near * again.t))
        return difference > 0;
    const RayPacket<double> from_start = with_square(broadcast(again.start), broadcast(dir),
                                                     vreal<double>(again.t * (1.0 - 2.0 * near)));
    const auto met_at = [&](std::int64_t number) {
        return first_lane<double>(refine_half(shapes, shapes.index[number], from_start).t);
    };
    const double apart = met_at(surface) - met_at(again.surface);
    if (magnitude(apart) <= one_place * again.t)
        return again.surface < surface;
    return magnitude(apart) <= 4.0 * near * again.t ? apart > 0 : difference > 0;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
