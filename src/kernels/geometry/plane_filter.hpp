#pragma once

#include "kernels/geometry/filter.hpp"
#include "kernels/geometry/plane.hpp"

// Certain tests of planes in single precision. Each group of rays sees the plane by the point
// nearest its origins, so that heights are as small as they can be.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A plane for the origins of one group: t = height / (normal·d), height = normal·(point - o).
struct PlaneFilter {
    float point[3];
    float normal[3];
    float height;        ///< over a shared origin, rounded once from double
    float height_error;  ///< at most
    float slope_error;   ///< of normal·d, per |d|
    std::int32_t surface;
};

template <bool Shared>
[[gnu::noinline]] PlaneFilter plane_filter(const abi::PlaneRecord<double>& plane,
                                           const Origins& origins)
{
    PlaneFilter filter{};
    double height = 0;
    double size = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double to_plane = plane.point[axis] - double{origins.center[axis]};
        height += plane.normal[axis] * to_plane;
        size += to_plane < 0 ? -to_plane : to_plane;
    }
    double off = 0;
    double distance2 = 0;
    double normal_error2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double point = double{origins.center[axis]} + height * plane.normal[axis];
        filter.point[axis] = static_cast<float>(point);
        filter.normal[axis] = static_cast<float>(plane.normal[axis]);
        const double moved = double{filter.point[axis]} - point;
        const double turned = double{filter.normal[axis]} - plane.normal[axis];
        off += moved < 0 ? -moved : moved;
        normal_error2 += turned * turned;
        const double from = double{filter.point[axis]} - double{origins.center[axis]};
        distance2 += from * from;
    }
    const double u = roundoffs(1.0f);
    const double normal_error = __builtin_sqrt(normal_error2);
    const double reach = __builtin_sqrt(distance2) * 1.000001 + double{origins.radius};
    const double magnitude = height < 0 ? -height : height;
    // Doubles lose 2^-50 of what enters the height.
    const double of_double = size * 0x1p-50;
    const double error = Shared ? 1.1 * u * magnitude + of_double
                                : off + (4.2 * u + normal_error) * reach + of_double;
    filter.height = static_cast<float>(height);
    filter.height_error = static_cast<float>(error) * (1.0f + roundoffs(4.0f));
    filter.slope_error = static_cast<float>(normal_error + 3.1 * u) * (1.0f + roundoffs(4.0f));
    filter.surface = plane.surface;
    return filter;
}

/// Where a plane is along the rays.
struct PlaneCrossing {
    vreal<float> low, high;
    std::uint32_t sure;  ///< lanes whose crossing is in [low, high]
    vreal<float> height, slope, slope_error;
};

/// Where it is not before in the other lanes, if ahead at all.
inline vreal<float> not_before(const PlaneFilter& filter, const PlaneCrossing& at)
{
    const vreal<float> height = abs(at.height) - vreal<float>(filter.height_error);
    return max(height, vreal<float>(0.0f)) / (abs(at.slope) + at.slope_error) *
           vreal<float>(1.0f - roundoffs(8.0f));
}

template <bool Shared>
inline PlaneCrossing crossing(const PlaneFilter& filter, const RayPacket<float>& rays,
                              const RayScale& scale)
{
    const Vec3v<float> normal = broadcast(filter.normal);
    const vreal<float> height =
        Shared ? vreal<float>(filter.height) : dot(normal, broadcast(filter.point) - rays.org);
    const vreal<float> slope = dot(normal, rays.dir);
    const vreal<float> slope_error = vreal<float>(filter.slope_error) * scale.length;
    const vreal<float> height_error(filter.height_error);
    const vreal<float> inverse = vreal<float>(1.0f) / slope;
    const vreal<float> t = height * inverse;
    const vreal<float> size = abs(t);
    // The true slope is half of this one at least in the lanes that are sure.
    const vreal<float> error =
        madd(madd(size, slope_error, height_error), vreal<float>(2.0f * inflation) * abs(inverse),
             size * vreal<float>(roundoffs(4.0f)));
    PlaneCrossing result{t - error, t + error, 0, height, slope, slope_error};
    result.sure = bits(abs(slope) > slope_error + slope_error);
    return result;
}

template <bool Shared>
inline void keep_plane(HitPacket<float>& hit, const PlaneFilter& filter,
                       const RayPacket<float>& rays, const RayScale& scale, std::uint32_t not_own)
{
    const PlaneCrossing at = crossing<Shared>(filter, rays, scale);
    const std::uint32_t ahead = at.sure & bits(at.low > rays.t_min);
    const std::uint32_t behind = at.sure & bits(at.high < rays.t_min);
    keep_sure(hit, from_bits<float>(ahead & not_own), at.low, at.high, filter.surface);
    const std::uint32_t rest = ~ahead & ~behind & not_own;
    if (rest != 0)
        keep_doubt(hit, from_bits<float>(rest),
                   select(from_bits<float>(at.sure), at.low, not_before(filter, at)), at.sure);
}

template <bool Shared>
inline Occlusion occludes(const PlaneFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end)
{
    const PlaneCrossing at = crossing<Shared>(filter, rays, scale);
    Occlusion result = root_between(at.low, at.high, at.sure, rays.t_min, t_end);
    const std::uint32_t flat = ~at.sure & all_lanes<float>;
    if (flat != 0) {
        const std::uint32_t unsure = flat & ~bits(not_before(filter, at) > t_end);
        note_in_the_way(unsure, abi::Cause::tangent);
        result.unsure |= unsure;
    }
    return result;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
