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

// Planes: the test, for rays from one point, too, a hit's place, and the test with error bounds.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Planes, and what lies in one: polygons.
template <class Record>
concept IsFlat = requires(const Record& flat)
{
    flat.point;
    flat.normal;
};

/// n·v of doubles in twice their digits, after T. Ogita, S. M. Rump and S. Oishi, "Accurate Sum and
/// Dot Product", SIAM J. Sci. Comput. 26(6), 2005; in their own where products are not fused.
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

/// n·v, which says by its sign, and by 0, on which side of a plane something is or whether it runs
/// along it. Where doubles cancel it is taken in twice their digits: of what is 0 rounding would
/// make a hit anywhere. Single precision alone (Accuracy::fast) has it as it comes.
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

/// Height of the plane over the origin along its normal. The origin is taken relative to the
/// plane's point, which halves the error of n·point - n·org.
template <class Real, IsFlat Flat>
inline vreal<Real> plane_height(const Flat& plane, const Vec3v<Real>& org)
{
    return dot_across<Real>(broadcast(plane.normal), broadcast(plane.point) - org);
}

/// Where the rays cross a plane; infinite or NaN for rays along it.
template <IsFlat Flat, class Real>
inline vreal<Real> plane_t(const Flat& plane, const RayPacket<Real>& rays)
{
    return plane_height<Real>(plane, rays.org) /
           dot_across<Real>(broadcast(plane.normal), rays.dir);
}

/// A plane seen from an origin that all rays share.
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

/// Whether all rays of a cone run away from it on the side they start on.
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

/// Keeps what is closer, but for the lanes of `own`.
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

/// Lanes that it is in the way of.
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

/// How far outside a point near the surface is, to first order; so in the other kinds' files.
template <IsFlat Flat>
inline vreal<double> height_over(const Flat& plane, unsigned, const Vec3v<double>& point)
{
    return dot(broadcast(plane.normal), point - broadcast(plane.point));
}

/// What is flat is never met again.
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

// Certain tests of planes in single precision. Each group of rays sees the plane by the point
// nearest its origins, so that heights are as small as they can be.

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
    vmask<float> sure;  ///< lanes whose crossing is in [low, high]
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
    return {t - error, t + error, abs(slope) > slope_error + slope_error,
            height,    slope,     slope_error};
}

template <bool Shared, class Own>
inline void keep_certain(HitPacket<float>& hit, const PlaneFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const std::uint32_t not_own = own.template lanes_on_others<float>(filter.surface);
    const PlaneCrossing at = crossing<Shared>(filter, rays, scale);
    const vmask<float> ahead = at.sure & (at.low > rays.t_min);
    const vmask<float> behind = at.sure & (at.high < rays.t_min);
    keep_sure(hit, ahead & from_bits<float>(not_own), at.low, at.high, filter.surface);
    const std::uint32_t rest = ~bits(ahead | behind) & not_own;
    if (rest != 0)
        keep_doubt(hit, from_bits<float>(rest), select(at.sure, at.low, not_before(filter, at)),
                   bits(at.sure));
}

template <bool Shared, class Own>
inline Occlusion occludes(const PlaneFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own&)
{
    const PlaneCrossing at = crossing<Shared>(filter, rays, scale);
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

template <bool Shared>
inline PlaneFilter certain_form(const abi::PlaneRecord<float>&,
                                const abi::PlaneRecord<double>& wide, const Origins& origins)
{
    return plane_filter<Shared>(wide, origins);
}

/// Whether all rays of a cone stay on the side they start on.
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

/// The kind (kinds.hpp).
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
