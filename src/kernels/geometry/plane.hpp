#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/observation.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/filter.hpp"
#include "kernels/geometry/object_list.hpp"
#include "kernels/geometry/one_surface.hpp"

#include <type_traits>

// Planes: the test, also for rays from one point, the point of a hit, and the test with error
// bounds.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Planes, and polygons, which lie in one.
template <class Record>
concept IsFlat = requires(const Record& flat)
{
    flat.point;
    flat.normal;
};

/// n·v in twice the digits of double, after T. Ogita, S. M. Rump and S. Oishi, "Accurate Sum and
/// Dot Product", SIAM J. Sci. Comput. 26(6), 2005. Without fused products it has the digits of
/// double only.
inline vreal<double> dot_in_twice(const Vec3v<double>& n, const Vec3v<double>& v)
{
    const Vec3v<double> product = n * v;
    const auto sum = [](const vreal<double>& a, const vreal<double>& b, vreal<double>& error) {
        const vreal<double> s = a + b;
        const vreal<double> of_b = s - a;
        error = error + ((a - (s - of_b)) + (b - of_b));
        return s;
    };
    vreal<double> error =
        msub(n.x, v.x, product.x) + msub(n.y, v.y, product.y) + msub(n.z, v.z, product.z);
    const vreal<double> two = sum(product.x, product.y, error);
    return sum(two, product.z, error) + error;
}

/// n·v. Its sign says on which side of a plane a point is; 0 means that a direction is parallel to
/// the plane. Where its terms cancel in double, it is computed with twice the digits, because
/// rounding errors instead of 0 would make a hit anywhere. Single precision without error bounds
/// (Accuracy::fast) uses the rounded value.
template <class Real>
inline vreal<Real> dot_across(const Vec3v<Real>& n, const Vec3v<Real>& v)
{
    const vreal<Real> rounded = dot(n, v);
    if constexpr (sizeof(Real) == sizeof(double)) {
        const auto cancels = abs(rounded) <= magnitude_dot(n, v) * vreal<double>(0x1p-48);
        if (any(cancels))
            return select(cancels, dot_in_twice(n, v), rounded);
    }
    return rounded;
}

/// The height of the plane over the origin, along its normal. Subtracting the origin from the
/// plane's point first halves the error of n·point - n·org.
template <class Real, IsFlat Flat>
inline vreal<Real> plane_height(const Flat& plane, const Vec3v<Real>& org)
{
    return dot_across<Real>(broadcast(plane.normal), broadcast(plane.point) - org);
}

/// The t at which rays hit a plane; infinite or NaN for rays parallel to it.
template <IsFlat Flat, class Real>
inline vreal<Real> plane_t(const Flat& plane, const RayPacket<Real>& rays)
{
    return plane_height<Real>(plane, rays.org) /
           dot_across<Real>(broadcast(plane.normal), rays.dir);
}

/// A plane for rays that share their origin.
template <class Real>
struct SharedOriginPlane {
    Real normal[3];
    Real height;
    std::int32_t surface;
};

template <class Real>
inline SharedOriginPlane<Real> share_origin(const abi::PlaneRecord<Real>& plane,
                                            const Vec3v<Real>& origin)
{
    return {{plane.normal[0], plane.normal[1], plane.normal[2]},
            first_lane<Real>(plane_height<Real>(plane, origin)),
            plane.surface};
}

template <class Real>
inline vreal<Real> plane_t(const SharedOriginPlane<Real>& plane, const RayPacket<Real>& rays)
{
    return vreal<Real>(plane.height) / dot_across<Real>(broadcast(plane.normal), rays.dir);
}

/// Whether all rays of a cone run away from the plane, on the side they start on.
template <class Real>
inline bool leaves_behind(const Cone<Real>& cone, const SharedOriginPlane<Real>& plane)
{
    const Real side = plane.height < 0 ? Real(-1) : Real(1);
    const Real towards[3] = {side * plane.normal[0], side * plane.normal[1],
                             side * plane.normal[2]};
    return plane.height != 0 && runs_against(cone, towards);
}

template <class Object, class Real>
concept IsPlane = std::is_same_v<Object, abi::PlaneRecord<Real>> ||
    std::is_same_v<Object, SharedOriginPlane<Real>>;

/// Keeps closer hits, except in lanes that start on the plane.
template <class Object, class Real, class Own>
requires IsPlane<Object, Real>
inline void keep_closest(HitPacket<Real>& hit, const Object& plane, const RayPacket<Real>& rays,
                         const Own& own)
{
    const vreal<Real> t = plane_t(plane, rays);
    const std::uint32_t ahead = bits(t > rays.t_min);
    keep_closer<Real>(hit,
                      from_bits<Real>(ahead & own.template lanes_on_others<Real>(plane.surface)), t,
                      plane.surface);
}

/// Lanes that the plane occludes.
template <class Object, class Real>
requires IsPlane<Object, Real>
inline std::uint32_t occluding_lanes(const RayEnd<Real>& end, const Object& plane,
                                     const RayPacket<Real>& rays)
{
    return bits(end.blocked_at(plane_t(plane, rays), rays));
}

template <class Real, class Visit>
inline void visit_crossings(const abi::PlaneRecord<Real>& plane, const RayPacket<Real>& rays,
                            const Visit& visit)
{
    visit(from_bits<Real>(all_lanes<Real>), plane_t(plane, rays), 0);
}

template <class Real, IsFlat Flat>
inline Vec3v<Real> unit_normal(const Flat& plane, unsigned, const Vec3v<Real>&, const Vec3v<Real>&)
{
    return broadcast_as<Real>(plane.normal);
}

/// The height of a point near the surface over it, to first order, positive outside. The other
/// kinds define the same.
template <IsFlat Flat>
inline vreal<double> height_over(const Flat& plane, unsigned, const Vec3v<double>& point)
{
    return dot(broadcast(plane.normal), point - broadcast(plane.point));
}

/// A ray that leaves a flat surface never hits it again.
template <IsFlat Flat>
inline HitAgain hit_again(const Flat&, unsigned)
{
    return HitAgain::never;
}
template <IsFlat Flat>
inline OwnCrossing second_crossing(const Flat&, unsigned, const Vec3v<double>&,
                                   const Vec3v<double>&, const vreal<double>&, vmask<double>)
{
    return {vreal<double>(__builtin_inf())};
}

template <IsFlat Flat>
inline RefinedHalf refine(const Flat& plane, unsigned, const RayPacket<double>& rays)
{
    const vreal<double> t = plane_t(plane, rays);
    return {t, point_at(rays, t), broadcast(plane.normal)};
}

template <IsFlat Flat>
inline AnchoredForm form_of(const Flat& plane)
{
    return anchored_form(plane.point, plane.normal, 0.0, 0.0);
}

// Tests of planes with error bounds, in single precision. Each set of rays gets its own point of
// the plane, the one nearest to the rays' origins, so that heights are as small as possible.

/// A plane for a set of ray origins: t = height / (normal·d), height = normal·(point - o).
struct PlaneFilter {
    float point[3];
    float normal[3];
    float height;        ///< over a shared origin, rounded once from double
    float height_error;  ///< upper bound
    float slope_error;   ///< upper bound for normal·d, per |d|
    std::int32_t surface;
};

template <Origin O>
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
    // The error in double is 2^-50 of the terms of the height.
    const double of_double = size * 0x1p-50;
    const double error = O == Origin::shared ? 1.1 * u * magnitude + of_double
                                             : off + (4.2 * u + normal_error) * reach + of_double;
    filter.height = static_cast<float>(height);
    filter.height_error = static_cast<float>(error) * (1.0f + roundoffs(4.0f));
    filter.slope_error = static_cast<float>(normal_error + 3.1 * u) * (1.0f + roundoffs(4.0f));
    filter.surface = plane.surface;
    return filter;
}

/// Where rays hit a plane.
struct PlaneCrossing {
    vreal<float> low, high;
    vmask<float> sure;  ///< lanes whose hit is certainly in [low, high]
    vreal<float> height, slope, slope_error;
};

/// In the other lanes, a lower bound of t, if the plane is ahead at all.
inline vreal<float> not_before(const PlaneFilter& filter, const PlaneCrossing& at)
{
    const vreal<float> height = abs(at.height) - vreal<float>(filter.height_error);
    return max(height, vreal<float>(0.0f)) / (abs(at.slope) + at.slope_error) *
           vreal<float>(1.0f - roundoffs(8.0f));
}

template <Origin O>
inline PlaneCrossing crossing(const PlaneFilter& filter, const RayPacket<float>& rays,
                              const RayScale& scale)
{
    const Vec3v<float> normal = broadcast(filter.normal);
    const vreal<float> height = O == Origin::shared
                                    ? vreal<float>(filter.height)
                                    : dot(normal, broadcast(filter.point) - rays.org);
    const vreal<float> slope = dot(normal, rays.dir);
    const vreal<float> slope_error = vreal<float>(filter.slope_error) * scale.length;
    const vreal<float> height_error(filter.height_error);
    const vreal<float> inverse = vreal<float>(1.0f) / slope;
    const vreal<float> t = height * inverse;
    const vreal<float> size = abs(t);
    // In the lanes that are sure, the true slope is at least half of this one.
    const vreal<float> error =
        madd(madd(size, slope_error, height_error), vreal<float>(2.0f * inflation) * abs(inverse),
             size * vreal<float>(roundoffs(4.0f)));
    return {t - error, t + error, abs(slope) > slope_error + slope_error,
            height,    slope,     slope_error};
}

template <Origin O, class Own>
inline void keep_certain(HitPacket<float>& hit, const PlaneFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const std::uint32_t not_own = own.template lanes_on_others<float>(filter.surface);
    const PlaneCrossing at = crossing<O>(filter, rays, scale);
    const vmask<float> ahead = at.sure & (at.low > rays.t_min);
    const vmask<float> behind = at.sure & (at.high < rays.t_min);
    keep_sure(hit, ahead & from_bits<float>(not_own), at.low, at.high, filter.surface);
    const std::uint32_t rest = ~bits(ahead | behind) & not_own;
    if (rest != 0)
        keep_doubt(hit, from_bits<float>(rest), select(at.sure, at.low, not_before(filter, at)),
                   bits(at.sure));
}

template <Origin O, class Own>
inline Occlusion occludes(const PlaneFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own&)
{
    const PlaneCrossing at = crossing<O>(filter, rays, scale);
    const std::uint32_t sure = bits(at.sure);
    Occlusion result = root_between(at.low, at.high, sure, rays.t_min, t_end);
    const std::uint32_t flat = ~sure & all_lanes<float>;
    if (flat != 0) {
        const std::uint32_t unsure = flat & ~bits(not_before(filter, at) > t_end);
        note_in_the_way(unsure, abi::Cause::tangent);
        result.unsure |= unsure;
    }
    return result;
}

template <Origin O>
inline PlaneFilter certain_form(const abi::PlaneRecord<float>&,
                                const abi::PlaneRecord<double>& wide, const Origins& origins)
{
    return plane_filter<O>(wide, origins);
}

/// Whether all rays of a cone stay on the side that they start on.
inline bool leaves_behind(const Cone<float>& cone, const PlaneFilter& plane)
{
    const float side = plane.height < 0 ? -1.0f : 1.0f;
    const float towards[3] = {side * plane.normal[0], side * plane.normal[1],
                              side * plane.normal[2]};
    const float away[3] = {-towards[0], -towards[1], -towards[2]};
    return stays_in_front(cone, plane.point, away) ||
           (cone.radius == 0 && side * plane.height > plane.height_error &&
            runs_against(cone, towards));
}

/// The kind, see kinds.hpp.
struct Plane : KindOf<abi::Primitive::plane, abi::SurfaceKind::plane> {
    template <class Real>
    using FromPoint = ObjectArray<SharedOriginPlane<Real>>;
    template <class Real>
    using Selected = SelectedRecords<abi::PlaneRecord<Real>>;
    using Certain = ObjectArray<PlaneFilter>;

    template <class Real>
    static const auto& list(const abi::GeometryView<Real>& scene)
    {
        return scene.planes;
    }
    static const auto* shapes(const abi::ShapesView& shapes)
    {
        return shapes.planes;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
