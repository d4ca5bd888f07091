#pragma once

#include "kernels/precision/refine.hpp"

// Rays that hit their own object again close to another surface.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where a ray hits again the object that it starts on (leave_surface.hpp).
struct MetAgain {
    double start[3];
    double t;  ///< infinite if it does not
    std::int32_t surface;
};

inline double near_own_hit(const Closeness& share, const MetAgain& again, const double (&dir)[3])
{
    const Vec3v<double> d = broadcast(dir);
    return first_lane<double>(
        near_own_hit<double>(share, vreal<double>(again.t), broadcast(again.start), dot(d, d)));
}

/// Two surfaces so close to each other count as at the same position: double cannot tell which is
/// first.
inline constexpr Closeness one_place{0x1p-44, 0x1p-50};

/// Whether the hit of a ray with its own object comes before the hit at `t` on `surface` (negative:
/// none). If the two are nearly_met<Real>, both are searched for again from the ray's start point,
/// because the search started from the offset origin and t was rounded. If they then are at the
/// same position, as the foot of a glass and the table, the surface with the lower number is hit.
/// If not, their new order counts where the shares of t are as close.
template <class Real>
inline bool meets_own_first(const abi::ShapesView& shapes, const MetAgain& again,
                            const double (&dir)[3], double t, std::int64_t surface)
{
    if (surface < 0)
        return true;
    const double difference = t - again.t;
    if (!(magnitude(difference) <= near_own_hit(nearly_met<Real>, again, dir)))
        return difference > 0;
    const double begin = again.t - 2.0 * near_own_hit(nearly_met<float>, again, dir);
    const RayPacket<double> from_start =
        with_square(broadcast(again.start), broadcast(dir), vreal<double>(begin));
    const auto met_at = [&](std::int64_t number) {
        return first_lane<double>(refine_half(shapes, shapes.index[number], from_start).t);
    };
    const double apart = met_at(surface) - met_at(again.surface);
    if (magnitude(apart) <= near_own_hit(one_place, again, dir))
        return again.surface < surface;
    const bool by_start = magnitude(difference) <= nearly_met<Real>.of_t * again.t &&
                          magnitude(apart) <= 4.0 * nearly_met<float>.of_t * again.t;
    return by_start ? apart > 0 : difference > 0;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
