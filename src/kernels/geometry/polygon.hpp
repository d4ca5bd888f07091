#pragma once

#include "kernel_abi/even_odd.hpp"
#include "kernels/geometry/ball_filter.hpp"
#include "kernels/geometry/plane.hpp"

// Planar polygons by the even-odd rule: the test, and for rays in single precision a float test
// that rejects most rays before the test in double. The point of a hit is that of the plane
// (plane.hpp).
//
// Corners are projected along the ray (the shear of Woop, Benthin and Wald, "Watertight
// Ray/Triangle Intersection", 2013). The test counts the edges that cross a half line which starts
// at the ray. Where rounding could decide on which side of the ray a corner or an edge is, the
// edges are counted again without rounding (even_odd.hpp). So polygons that share an edge agree
// about it, and no ray passes between them or hits the wrong one.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Lanes whose direction is longest along z, and lanes whose x component is no shorter than y; x is
/// used only where z is not the longest.
template <class Real>
struct LongestAxis {
    vmask<Real> z, x;
};

template <class Real>
inline LongestAxis<Real> longest_axis(const Vec3v<Real>& dir)
{
    const Vec3v<Real> size{abs(dir.x), abs(dir.y), abs(dir.z)};
    return {(size.z >= size.x) & (size.z >= size.y), size.x >= size.y};
}

/// A component of a vector; axis 3 is x again.
template <int axis, class Real>
inline const vreal<Real>& component(const Vec3v<Real>& v)
{
    if constexpr (axis % 3 == 0)
        return v.x;
    else if constexpr (axis % 3 == 1)
        return v.y;
    else
        return v.z;
}

/// The lanes of `unsure` whose lines pass through the polygon, decided without rounding.
template <class Real>
[[gnu::noinline]] std::uint32_t passes_through_exactly(const abi::PolygonRecord<Real>& polygon,
                                                       const RayPacket<Real>& rays,
                                                       std::uint32_t unsure)
{
    const Vec3v<Real> vectors[2] = {rays.org, rays.dir};
    alignas(64) Real by_lane[2][3][lanes<Real>];
    for (int i = 0; i < 2; ++i) {
        store(by_lane[i][0], vectors[i].x);
        store(by_lane[i][1], vectors[i].y);
        store(by_lane[i][2], vectors[i].z);
    }
    std::uint32_t inside = 0;
    for (std::uint32_t left = unsure; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        double org[3], dir[3];
        for (int axis = 0; axis < 3; ++axis) {
            org[axis] = by_lane[0][axis][lane];
            dir[axis] = by_lane[1][axis][lane];
        }
        abi::EvenOdd<double> rule(org, dir);
        for (std::int32_t i = 0; i < polygon.corner_count; ++i) {
            const abi::PolygonCorner<Real>& corner = polygon.corners[i];
            const double position[3] = {corner.position[0], corner.position[1], corner.position[2]};
            if (corner.starts_contour != 0)
                rule.start(position);
            else
                rule.edge_to(position);
        }
        inside |= std::uint32_t{rule.inside()} << lane;
    }
    return inside;
}

/// The result of counting edges.
struct EdgeCount {
    std::uint32_t odd = 0;     ///< lanes with an odd count: inside
    std::uint32_t unsure = 0;  ///< lanes in which rounding may have decided
};

/// A corner projected along the rays, and the lanes in which v >= 0.
template <class Real>
struct SeenCorner {
    vreal<Real> u, v;
    std::uint32_t above;
};

/// Lanes in which rounding may have decided the sign of a corner's v or of an edge's turn, of which
/// the smallest magnitudes are given (docs/numerics_derivations.md).
template <int along, class Real>
[[gnu::always_inline]] inline std::uint32_t uncertain_lanes(const abi::PolygonRecord<Real>& polygon,
                                                            const RayPacket<Real>& rays,
                                                            const vreal<Real>& least_v,
                                                            const vreal<Real>& least_turn)
{
    constexpr Real roundoffs_16 = sizeof(Real) == 4 ? Real(0x1p-20) : Real(0x1p-49);
    const Real radius = polygon.bound_radius;
    const vreal<Real> depth =
        abs(component<along>(broadcast(polygon.bound) - rays.org)) + vreal<Real>(radius);
    return bits(either<Real>(least_v <= depth * vreal<Real>(roundoffs_16),
                             least_turn <= depth * vreal<Real>(8 * roundoffs_16 * radius)));
}

/// Counts the edges for rays whose longest axis is `along`; the result of other lanes is
/// meaningless.
template <int along, class Real>
[[gnu::always_inline]] inline EdgeCount count_edges(const abi::PolygonRecord<Real>& polygon,
                                                    const RayPacket<Real>& rays)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> back = vreal<Real>(Real(-1)) / component<along>(rays.dir);
    const vreal<Real> back_u = back * component<along + 1>(rays.dir);
    const vreal<Real> back_v = back * component<along + 2>(rays.dir);
    vreal<Real> least_v(static_cast<Real>(__builtin_inf()));
    vreal<Real> least_turn = least_v;
    EdgeCount count;
    const auto see = [&](std::int32_t i) {
        const Vec3v<Real> w = broadcast(polygon.corners[i].position) - rays.org;
        const vreal<Real> v = madd(back_v, component<along>(w), component<along + 2>(w));
        least_v = min(least_v, abs(v));
        return SeenCorner<Real>{madd(back_u, component<along>(w), component<along + 1>(w)), v,
                                bits(v >= zero)};
    };
    SeenCorner<Real> from;
    const auto add_edge_to = [&](const SeenCorner<Real>& to) {
        const std::uint32_t crosses = to.above ^ from.above;
        if (crosses != 0) {
            // The edge crosses v = 0 at u = turn / (to.v - from.v).
            const vreal<Real> turn = msub(from.u, to.v, to.u * from.v);
            least_turn = min(least_turn, abs(turn));
            count.odd ^= crosses & ~(to.above ^ bits(turn > zero));
        }
        from = to;
    };
    for (std::int32_t i = 0; i < polygon.corner_count; ++i) {
        const SeenCorner<Real> first = see(i);
        from = first;
        // The last corner of a contour is its first one again.
        while (++i + 1 < polygon.corner_count && polygon.corners[i + 1].starts_contour == 0)
            add_edge_to(see(i));
        add_edge_to(first);
    }
    count.unsure = uncertain_lanes<along>(polygon, rays, least_v, least_turn);
    return count;
}

/// The lanes of `active` whose lines pass through the polygon, ahead of the origin or behind it.
template <class Real>
[[gnu::noinline]] std::uint32_t passes_through(const abi::PolygonRecord<Real>& polygon,
                                               const RayPacket<Real>& rays, std::uint32_t active)
{
    const LongestAxis<Real> longest = longest_axis<Real>(rays.dir);
    const std::uint32_t z = active & bits(longest.z);
    const std::uint32_t x = active & ~z & bits(longest.x);
    const std::uint32_t y = active & ~z & ~x;
    EdgeCount found;
    const auto take = [&](std::uint32_t lanes_of_axis, const EdgeCount& count) {
        found.odd |= lanes_of_axis & count.odd;
        found.unsure |= lanes_of_axis & count.unsure;
    };
    if (x != 0)
        take(x, count_edges<0>(polygon, rays));
    if (y != 0)
        take(y, count_edges<1>(polygon, rays));
    if (z != 0)
        take(z, count_edges<2>(polygon, rays));
    if (found.unsure == 0)
        return found.odd;
    return (found.odd & ~found.unsure) | passes_through_exactly(polygon, rays, found.unsure);
}

/// `t`, clamped to the interval between the edges that cross the half line, as far as rounding
/// finds any: where a line passes through, edges before and behind its hit cross the half line. `t`
/// itself if rounding finds no such edge.
template <class Real>
[[gnu::noinline]] vreal<Real> between_edges(const abi::PolygonRecord<Real>& polygon,
                                            const RayPacket<Real>& rays, const vreal<Real>& t)
{
    const vreal<Real> zero(Real(0));
    const LongestAxis<Real> longest = longest_axis<Real>(rays.dir);
    const auto by_axis = [&](const vreal<Real>& z, const vreal<Real>& x, const vreal<Real>& y) {
        return select(longest.z, z, select(longest.x, x, y));
    };
    vreal<Real> first(static_cast<Real>(__builtin_inf()));
    vreal<Real> last(static_cast<Real>(-__builtin_inf()));
    const vreal<Real> length = by_axis(rays.dir.z, rays.dir.x, rays.dir.y);
    const vreal<Real> across = by_axis(rays.dir.y, rays.dir.z, rays.dir.x);
    vreal<Real> from_v = zero;
    vreal<Real> from_depth = zero;
    for (std::int32_t i = 0; i < polygon.corner_count; ++i) {
        const abi::PolygonCorner<Real>& corner = polygon.corners[i];
        const Vec3v<Real> w = broadcast(corner.position) - rays.org;
        const vreal<Real> at = by_axis(w.z, w.x, w.y) / length;
        const vreal<Real> v = by_axis(w.y, w.z, w.x) - at * across;
        const auto crosses = from_bits<Real>(
            corner.starts_contour != 0 ? 0 : bits(v >= zero) ^ bits(from_v >= zero));
        const vreal<Real> here = from_depth + (at - from_depth) * (from_v / (from_v - v));
        first = select(crosses, min(first, here), first);
        last = select(crosses, max(last, here), last);
        from_v = v;
        from_depth = at;
    }
    return select(first <= last, select(t > first, min(t, last), first), t);
}

/// If |normal·d| is below this share of |d|, rounding may decide its sign.
template <class Real>
inline constexpr Real edge_on = sizeof(Real) == 4 ? Real(0x1p-16) : Real(0x1p-44);

/// Lanes whose rays certainly start in the polygon's plane: every term of their height is 0.
template <class Real>
inline vmask<Real> starts_in_plane(const abi::PolygonRecord<Real>& polygon,
                                   const RayPacket<Real>& rays)
{
    return magnitude_dot(broadcast(polygon.normal), broadcast(polygon.point) - rays.org) <=
           vreal<Real>(Real(0));
}

/// The t at which rays hit the polygon's plane. For rays nearly parallel to the plane, t is clamped
/// to where they can be inside, as rounding may let them pass through. A ray that starts in the
/// plane hits it there.
template <class Real>
inline vreal<Real> polygon_t(const abi::PolygonRecord<Real>& polygon, const RayPacket<Real>& rays)
{
    const Vec3v<Real> normal = broadcast(polygon.normal);
    const vreal<Real> slope = dot_across<Real>(normal, rays.dir);
    const vreal<Real> t = plane_height<Real>(polygon, rays.org) / slope;
    const vreal<Real> length = size_of(rays.dir);
    // For rays with a NaN no comparison holds, and they keep their t, a NaN.
    const auto sees_edge = abs(slope) <= vreal<Real>(edge_on<Real>) * length;
    if (none(sees_edge))
        return t;
    const std::uint32_t within = bits(sees_edge) & ~bits(starts_in_plane(polygon, rays));
    return select(from_bits<Real>(within), between_edges(polygon, rays, t), t);
}

/// Lanes whose rays are so far from parallel to the polygon's plane that their hit is that of the
/// plane.
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

/// Polygons have no form of their own for rays from one point.
template <class Real>
inline abi::PolygonRecord<Real> share_origin(const abi::PolygonRecord<Real>& polygon,
                                             const Vec3v<Real>&)
{
    return polygon;
}

/// Keeps closer hits, except in lanes that start on the polygon.
template <class Real, class Own>
inline void keep_closest(HitPacket<Real>& hit, const abi::PolygonRecord<Real>& polygon,
                         const RayPacket<Real>& rays, const Own& own)
{
    const vreal<Real> t = polygon_t(polygon, rays);
    const std::uint32_t ahead =
        bits((t > rays.t_min) & (t <= hit.t)) & own.template lanes_on_others<Real>(polygon.surface);
    if (ahead != 0)
        keep_closer<Real>(hit, from_bits<Real>(passes_through(polygon, rays, ahead)), t,
                          polygon.surface);
}

/// Lanes that the polygon occludes.
template <class Real>
inline std::uint32_t occluding_lanes(const RayEnd<Real>& end,
                                     const abi::PolygonRecord<Real>& polygon,
                                     const RayPacket<Real>& rays)
{
    const std::uint32_t ahead = bits(end.blocked_at(polygon_t(polygon, rays), rays));
    return ahead == 0 ? 0 : passes_through(polygon, rays, ahead);
}

template <class Real, class Visit>
inline void visit_crossings(const abi::PolygonRecord<Real>& polygon, const RayPacket<Real>& rays,
                            const Visit& visit)
{
    visit(from_bits<Real>(passes_through(polygon, rays, all_lanes<Real>)), polygon_t(polygon, rays),
          0);
}

/// A polygon for a set of ray origins in single precision.
struct PolygonFilter {
    const abi::PolygonRecord<double>* wide;
    BallFilter ball;
    std::int32_t surface;
};

template <Origin O>
inline PolygonFilter certain_form(const abi::PolygonRecord<float>& record,
                                  const abi::PolygonRecord<double>& wide, const Origins& origins)
{
    return {&wide, ball_filter<O>(wide.bound, record.bound_radius, origins), wide.surface};
}

/// Hits with a polygon beyond t_min.
struct PolygonCrossings {
    vreal<float> low, high;
    std::uint32_t valid;
};

/// The same for half a packet.
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
    half.valid = ahead == 0 ? 0 : passes_through(polygon, rays, ahead);
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

/// Rays that may hit the ball are tested in double.
template <Origin O, class Own>
inline void keep_certain(HitPacket<float>& hit, const PolygonFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const std::uint32_t active =
        others_near_ball<O>(filter.ball, {filter.surface}, rays, scale, hit.t, own);
    if (active == 0)
        return;
    const PolygonCrossings at = crossings_in_double(*filter.wide, rays, active);
    if (at.valid != 0)
        keep_sure(hit, from_bits<float>(at.valid), at.low, at.high, filter.surface);
}

template <Origin O, class Own>
inline Occlusion occludes(const PolygonFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own& own)
{
    const std::uint32_t active =
        others_near_ball<O>(filter.ball, {filter.surface}, rays, scale, t_end, own);
    if (active == 0)
        return {};
    const PolygonCrossings at = crossings_in_double(*filter.wide, rays, active);
    return root_between(at.low, at.high, at.valid, rays.t_min, t_end);
}

/// The kind, see kinds.hpp. Only kernels with Features::quadrics have it.
struct Polygon
    : KindOf<abi::Primitive::polygon, abi::SurfaceKind::polygon, 1, CompiledFor::quadrics> {
    template <class Real>
    using FromPoint = ObjectArray<abi::PolygonRecord<Real>>;
    template <class Real>
    using Selected = SelectedRecords<abi::PolygonRecord<Real>>;
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
