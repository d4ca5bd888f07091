#pragma once

#include "kernels/geometry/ball_filter.hpp"
#include "kernels/geometry/plane.hpp"

// Planar polygons by the even-odd rule: the test, and, for rays in single precision, a certain
// rejection with the test in double behind it. A hit's place is that of the plane (plane.hpp).
//
// Corners are projected along the ray (the shear of Woop, Benthin and Wald, "Watertight
// Ray/Triangle Intersection", 2013), and the edges counted that cross a half line from where the
// ray stands. What is computed of a corner hangs on the corner and the ray alone, and an edge's
// part changes nothing but its sign with the edge's direction: polygons that share an edge decide
// it alike, so that no ray slips between them.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Two directions across a ray: e·(p - org) is where a point is seen along it; and the axis that it
/// goes along the most.
template <class Real>
struct AcrossRay {
    Vec3v<Real> u, v, longest;
};

/// Along two axes, moved by as much as the ray goes along the third, its longest.
template <class Real>
inline AcrossRay<Real> across(const Vec3v<Real>& dir)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> one(Real(1));
    const Vec3v<Real> size{abs(dir.x), abs(dir.y), abs(dir.z)};
    const auto z_longest = (size.z >= size.x) & (size.z >= size.y);
    const auto x_longest = size.x >= size.y;
    const vreal<Real> longest = select(z_longest, dir.z, select(x_longest, dir.x, dir.y));
    const Vec3v<Real> back = scale<Real>(vreal<Real>(Real(-1)) / longest, dir);
    const auto by_axis = [&](const vreal<Real>& z, const vreal<Real>& x, const vreal<Real>& y) {
        return select(z_longest, z, select(x_longest, x, y));
    };
    return {{by_axis(one, back.y, one), by_axis(zero, one, back.x), by_axis(back.x, zero, zero)},
            {by_axis(zero, back.z, zero), by_axis(one, zero, back.z), by_axis(back.y, one, one)},
            {by_axis(zero, one, zero), by_axis(zero, zero, one), by_axis(one, zero, zero)}};
}

/// A corner as the rays see it.
template <class Real>
struct SeenCorner {
    vreal<Real> u, v;
};

/// Lanes whose rays pass through the polygon, ahead of their origins or behind.
template <class Real>
[[gnu::noinline]] std::uint32_t passes_through(const abi::PolygonRecord<Real>& polygon,
                                               const RayPacket<Real>& rays)
{
    const vreal<Real> zero(Real(0));
    const AcrossRay<Real> axes = across<Real>(rays.dir);
    std::uint32_t inside = 0;
    SeenCorner<Real> from{zero, zero};
    std::uint32_t from_above = 0;
    for (std::int32_t i = 0; i < polygon.corner_count; ++i) {
        const abi::PolygonCorner<Real>& corner = polygon.corners[i];
        const Vec3v<Real> w = broadcast(corner.position) - rays.org;
        const SeenCorner<Real> to{dot(axes.u, w), dot(axes.v, w)};
        const std::uint32_t above = bits(to.v >= zero);
        const std::uint32_t crosses = corner.starts_contour != 0 ? 0 : above ^ from_above;
        if (crosses != 0) {
            // The edge is at u = turn / (to.v - from.v) where it crosses v = 0.
            const vreal<Real> turn = from.u * to.v - to.u * from.v;
            inside ^= crosses & ((above & bits(turn > zero)) | (~above & bits(turn < zero)));
        }
        from = to;
        from_above = above;
    }
    return inside;
}

/// `t`, but no further along the rays than the edges that passes_through() finds to cross: those on
/// either side of a ray that passes through have their crossings before and behind its own.
template <class Real>
[[gnu::noinline]] vreal<Real> between_edges(const abi::PolygonRecord<Real>& polygon,
                                            const RayPacket<Real>& rays, const vreal<Real>& t)
{
    const vreal<Real> zero(Real(0));
    const AcrossRay<Real> axes = across<Real>(rays.dir);
    vreal<Real> first(static_cast<Real>(__builtin_inf()));
    vreal<Real> last(static_cast<Real>(-__builtin_inf()));
    const vreal<Real> length = dot(axes.longest, rays.dir);
    vreal<Real> from_v = zero;
    vreal<Real> from_depth = zero;
    for (std::int32_t i = 0; i < polygon.corner_count; ++i) {
        const abi::PolygonCorner<Real>& corner = polygon.corners[i];
        const Vec3v<Real> w = broadcast(corner.position) - rays.org;
        const vreal<Real> v = dot(axes.v, w);
        const vreal<Real> at = dot(axes.longest, w) / length;
        const auto crosses = from_bits<Real>(
            corner.starts_contour != 0 ? 0 : bits(v >= zero) ^ bits(from_v >= zero));
        const vreal<Real> here = from_depth + (at - from_depth) * (from_v / (from_v - v));
        first = select(crosses, min(first, here), first);
        last = select(crosses, max(last, here), last);
        from_v = v;
        from_depth = at;
    }
    return select(t > first, min(t, last), first);
}

/// Below this share of a direction's length rounding may decide about its slope to a plane.
template <class Real>
inline constexpr Real edge_on = sizeof(Real) == 4 ? Real(0x1p-16) : Real(0x1p-44);

/// Where rays cross the polygon's plane; of rays that see it from its edge, where they can be
/// inside, as rounding may have them pass through.
template <class Real>
inline vreal<Real> polygon_t(const abi::PolygonRecord<Real>& polygon, const RayPacket<Real>& rays)
{
    const Vec3v<Real> normal = broadcast(polygon.normal);
    const vreal<Real> slope = dot_across<Real>(normal, rays.dir);
    const vreal<Real> t = plane_height<Real>(polygon, rays.org) / slope;
    const vreal<Real> length = abs(rays.dir.x) + abs(rays.dir.y) + abs(rays.dir.z);
    const auto tells = abs(slope) > vreal<Real>(edge_on<Real>) * length;
    return bits(tells) == all_lanes<Real> ? t : select(tells, t, between_edges(polygon, rays, t));
}

/// Lanes whose rays are so far from running in the polygon's plane that their hit is the plane's.
inline std::uint32_t steep_lanes(const abi::PolygonRecord<double>& polygon,
                                 const RayPacket<float>& rays)
{
    const vreal<float> slope = dot(broadcast_as<float>(polygon.normal), rays.dir);
    return bits(slope * slope > vreal<float>(0x1p-20f) * rays.dir2);
}

inline RefinedHalf refine(const abi::PolygonRecord<double>& polygon, unsigned,
                          const RayPacket<double>& rays)
{
    const vreal<double> t = polygon_t(polygon, rays);
    return {t, point_at(rays, t), broadcast(polygon.normal)};
}

/// Rays from one point see it as others do.
template <class Real>
inline abi::PolygonRecord<Real> share_origin(const abi::PolygonRecord<Real>& polygon,
                                             const Vec3v<Real>&)
{
    return polygon;
}

/// Keeps what is closer, but for the lanes of `own`.
template <class Real, class Own>
inline void keep_closest(HitPacket<Real>& hit, const abi::PolygonRecord<Real>& polygon,
                         const RayPacket<Real>& rays, const Own& own)
{
    const vreal<Real> t = polygon_t(polygon, rays);
    const std::uint32_t ahead =
        bits((t > rays.t_min) & (t <= hit.t)) & own.template lanes_on_others<Real>(polygon.surface);
    if (ahead != 0)
        keep_closer<Real>(hit, from_bits<Real>(ahead & passes_through(polygon, rays)), t,
                          polygon.surface);
}

/// Lanes that it is in the way of.
template <class Real>
inline std::uint32_t occluding_lanes(const RayEnd<Real>& end,
                                     const abi::PolygonRecord<Real>& polygon,
                                     const RayPacket<Real>& rays)
{
    const std::uint32_t ahead = bits(end.blocked_at(polygon_t(polygon, rays), rays));
    return ahead == 0 ? 0 : ahead & passes_through(polygon, rays);
}

template <class Real, class Visit>
inline void visit_crossings(const abi::PolygonRecord<Real>& polygon, const RayPacket<Real>& rays,
                            const Visit& visit)
{
    visit(from_bits<Real>(passes_through(polygon, rays)), polygon_t(polygon, rays), 0);
}

/// A polygon for the origins of one group of rays in single precision.
struct PolygonFilter {
    const abi::PolygonRecord<double>* wide;
    BallFilter ball;
    std::int32_t surface;
};

template <bool Shared>
inline PolygonFilter certain_form(const abi::PolygonRecord<float>& record,
                                  const abi::PolygonRecord<double>& wide, const Origins& origins)
{
    return {&wide, ball_filter<Shared>(wide.bound, record.bound_radius, origins), wide.surface};
}

/// Where rays cross a polygon beyond t_min.
struct PolygonCrossings {
    vreal<float> low, high;
    std::uint32_t valid;
};

/// Of half a packet.
struct HalfPolygonCrossings {
    vreal<double> t = vreal<double>(0.0);
    std::uint32_t valid = 0;
};

inline HalfPolygonCrossings half_crossings(const abi::PolygonRecord<double>& polygon,
                                           const RayPacket<double>& rays)
{
    HalfPolygonCrossings half;
    half.t = polygon_t(polygon, rays);
    const std::uint32_t ahead =
        bits((half.t > rays.t_min) & (half.t < vreal<double>(__builtin_inf())));
    half.valid = ahead == 0 ? 0 : ahead & passes_through(polygon, rays);
    return half;
}

[[gnu::noinline]] inline PolygonCrossings crossings_in_double(
    const abi::PolygonRecord<double>& polygon, const RayPacket<float>& rays, std::uint32_t active)
{
    HalfPolygonCrossings low;
    HalfPolygonCrossings high;
    if ((active & all_lanes<double>) != 0)
        low = half_crossings(polygon, widen_low(rays));
    if (active >> lanes<double> != 0)
        high = half_crossings(polygon, widen_high(rays));
    const vreal<float> t = narrow(low.t, high.t);
    return {rounded_low(t), rounded_high(t), active & narrow_bits(low.valid, high.valid)};
}

/// What may hit is tested in double.
template <bool Shared, class Own>
inline void keep_certain(HitPacket<float>& hit, const PolygonFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const std::uint32_t active = may_hit_ball<Shared>(filter.ball, rays, scale, hit.t) &
                                 own.template lanes_on_others<float>(filter.surface);
    if (active == 0)
        return;
    const PolygonCrossings at = crossings_in_double(*filter.wide, rays, active);
    if (at.valid != 0)
        keep_sure(hit, from_bits<float>(at.valid), at.low, at.high, filter.surface);
}

template <bool Shared, class Own>
inline Occlusion occludes(const PolygonFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own& own)
{
    const std::uint32_t active = may_hit_ball<Shared>(filter.ball, rays, scale, t_end) &
                                 own.template lanes_on_others<float>(filter.surface);
    if (active == 0)
        return {};
    const PolygonCrossings at = crossings_in_double(*filter.wide, rays, active);
    return root_between(at.low, at.high, at.valid, rays.t_min, t_end);
}

/// The kind (kinds.hpp). Kernels have it with the quadrics.
struct Polygon : KindOf<abi::Primitive::polygon, abi::SurfaceKind::polygon, 1, true> {
    template <class Real>
    using FromPoint = ObjectArray<abi::PolygonRecord<Real>>;
    using Certain = ObjectArray<PolygonFilter>;

    template <class Real>
    static const auto& list(const abi::GeometryView<Real>& scene)
    {
        return scene.polygons;
    }
    static const auto* shapes(const abi::ShapesView& shapes)
    {
        return shapes.polygons;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
