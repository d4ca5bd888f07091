#pragma once

#include "kernels/geometry/quadric_body.hpp"
#include "kernels/geometry/quadric_bounds.hpp"
#include "kernels/geometry/quadric_place.hpp"

// Quadrics for rays in single precision: what bounds tell for sure, and behind it the test in
// double, two half packets at a time.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline Body body_of(const QuadricFilter& quadric)
{
    return body_of(*quadric.record);
}

/// The unclipped side along the rays, a t² + 2 b t + c = 0, by its discriminant.
struct QuadricLine {
    Vec3v<float> p;
    Vec3v<float> v;
    vreal<float> height;
    vreal<float> a;
    vreal<float> discriminant;
    vreal<float> discriminant_error;
};

template <bool Shared>
inline QuadricLine line_of(const QuadricFilter& filter, const RayPacket<float>& rays)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    QuadricLine line;
    if constexpr (Shared) {
        line.p = broadcast(filter.p);
        line.height = vreal<float>(filter.height);
    } else {
        const QuadricOrigin<float> origin = quadric_origin<float>(quadric, rays.org);
        line.p = origin.p;
        line.height = origin.height;
    }
    line.v = apply_inverse(quadric, rays.dir);
    line.a = dot(broadcast(quadric.square) * line.v, line.v);
    line.discriminant = quadric_discriminant<float>(quadric, cross(line.p, line.v), line.v, line.a);
    line.discriminant_error = vreal<float>(filter.discriminant_error) * rays.dir2;
    return line;
}

/// Lanes that surely miss the surface: those that cross the unclipped side nowhere and, where there
/// are caps, are outside of it all along.
inline std::uint32_t surely_misses(const QuadricFilter& filter, const QuadricLine& line,
                                   const RayPacket<float>& rays)
{
    const vreal<float> error = line.discriminant_error;
    const auto misses =
        (line.discriminant < negated(error)) & (error > vreal<float>(smallest_error));
    if (!filter.record->capped)
        return bits(misses);
    return bits(misses & (line.a > vreal<float>(filter.bend_error) * rays.dir2));
}

/// The roots of the lanes of `convex`, whose a is surely above 0: rays are inside of the unclipped
/// side between them alone. The first is in [low, low + width], the other in [high - width, high],
/// or where they are not in `crosses` there may be none.
struct SideRoots {
    vreal<float> low, high;
    vreal<float> width;
    std::uint32_t convex;
    std::uint32_t crosses;
};

inline SideRoots side_roots(const QuadricFilter& filter, const QuadricLine& line,
                            const RayPacket<float>& rays, const RayScale& scale)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    const vreal<float> smallest(smallest_error);
    const vreal<float> error = line.discriminant_error;
    const vreal<float> bend_error = vreal<float>(filter.bend_error) * rays.dir2;
    SideRoots roots;
    roots.convex = bits((line.a > vreal<float>(4.0f) * bend_error) & (line.a > smallest) &
                        (line.discriminant >= negated(error)) & (error > smallest));
    if (roots.convex == 0)
        return roots;
    roots.crosses = roots.convex & bits(line.discriminant > error);
    const vreal<float> b = madd(vreal<float>(quadric.linear), line.v.z,
                                dot(broadcast(quadric.square) * line.p, line.v));
    const vreal<float> inverse = vreal<float>(1.0f) / line.a;
    const vreal<float> most = line.discriminant + error;
    const vreal<float> inverse_root = rough_inverse_sqrt(max(most, smallest));
    const vreal<float> root = most * inverse_root;
    const vreal<float> share =
        madd(vreal<float>(1.34f) * bend_error, inverse, vreal<float>(roundoffs(24.0f)));
    const vreal<float> slack =
        madd(abs(b) + root, share, vreal<float>(1.34f * filter.slope_error) * scale.length);
    const vreal<float> middle = negated(b) * inverse;
    const vreal<float> half = (root + slack) * inverse;
    roots.low = middle - half;
    roots.high = middle + half;
    roots.width = vreal<float>(2.02f) * (madd(error, inverse_root, slack) * inverse);
    return roots;
}

/// Heights along the rays, and what they may be off by beside the error of the origin's.
struct ClipHeights {
    vreal<float> origin;
    vreal<float> climb;
    vreal<float> error;

    ClipHeights(const QuadricFilter& filter, const QuadricLine& line, const RayPacket<float>& rays,
                const RayScale& scale)
        : origin(line.height),
          climb(dot(broadcast(filter.record->clip), rays.dir)),
          error(vreal<float>(filter.climb_error) * scale.length)
    {
    }
    vreal<float> at(const vreal<float>& t) const
    {
        return madd(t, climb, origin);
    }
};

/// Lanes of `convex` whose rays are outside of the unclipped side, or not between the clipping
/// planes, wherever they are between t_min and t_end.
inline std::uint32_t surely_passes(const QuadricFilter& filter, const QuadricLine& line,
                                   const SideRoots& roots, const RayPacket<float>& rays,
                                   const RayScale& scale, const vreal<float>& t_end)
{
    const vreal<float> from = max(roots.low, rays.t_min);
    const vreal<float> to = min(roots.high, t_end);
    const std::uint32_t nowhere = bits(from > to);
    if (!filter.record->clipped)
        return roots.convex & nowhere;
    const ClipHeights heights(filter, line, rays, scale);
    const vreal<float> first = heights.at(from);
    const vreal<float> last = heights.at(to);
    const vreal<float> first_error = abs(from) * heights.error;
    const vreal<float> last_error = abs(to) * heights.error;
    const vreal<float> low(filter.outer_low);
    const vreal<float> high(filter.outer_high);
    return roots.convex & (nowhere | bits((first + first_error < low) & (last + last_error < low)) |
                           bits((first - first_error > high) & (last - last_error > high)));
}

/// Lanes of `crosses` of which one root surely lies between t_min and t_end, and between the
/// clipping planes.
inline std::uint32_t surely_blocks(const QuadricFilter& filter, const QuadricLine& line,
                                   const SideRoots& roots, const RayPacket<float>& rays,
                                   const RayScale& scale, const vreal<float>& t_end)
{
    const ClipHeights heights(filter, line, rays, scale);
    const vreal<float> inner_low(filter.inner_low);
    const vreal<float> inner_high(filter.inner_high);
    const auto counts = [&](const vreal<float>& low, const vreal<float>& high) {
        const std::uint32_t ahead = bits((low > rays.t_min) & (high < t_end));
        if (!filter.record->clipped)
            return ahead;
        const vreal<float> first = heights.at(low);
        const vreal<float> last = heights.at(high);
        const vreal<float> error = max(abs(low), abs(high)) * heights.error;
        return ahead & bits((min(first, last) - error > inner_low) &
                            (max(first, last) + error < inner_high));
    };
    return roots.crosses & (counts(roots.low, roots.low + roots.width) |
                            counts(roots.high - roots.width, roots.high));
}

/// What is asked of a quadric.
enum class QuadricQuery { closest, occlusion };

/// What single precision tells of some lanes.
struct QuadricCrossing {
    std::uint32_t blocked;  ///< lanes with a crossing between t_min and t_end; only of occlusion
    std::uint32_t left;     ///< other lanes that may have one, in double to be looked at
};

template <QuadricQuery Query, bool Shared>
[[gnu::noinline]] QuadricCrossing crossing_of(const QuadricFilter& filter,
                                              const RayPacket<float>& rays, const RayScale& scale,
                                              const vreal<float>& t_end, std::uint32_t near)
{
    const QuadricLine line = line_of<Shared>(filter, rays);
    near &= ~surely_misses(filter, line, rays);
    if (near == 0)
        return {0, 0};
    const SideRoots roots = side_roots(filter, line, rays, scale);
    if (roots.convex == 0)
        return {0, near};
    near &= ~surely_passes(filter, line, roots, rays, scale, t_end);
    if (Query == QuadricQuery::closest || near == 0)
        return {0, near};
    const std::uint32_t blocked = near & surely_blocks(filter, line, roots, rays, scale, t_end);
    return {blocked, near & ~blocked};
}

/// The same of the lanes whose rays do not start on the quadric's body.
template <QuadricQuery Query, bool Shared, class Own>
inline QuadricCrossing certain_crossing(const QuadricFilter& filter, const RayPacket<float>& rays,
                                        const RayScale& scale, const vreal<float>& t_end,
                                        const Own& own)
{
    const Body body = body_of(filter);
    std::uint32_t near = own.template lanes_on_others<float>(body.first, body.pieces);
    if (filter.ball.outer2 < __builtin_inff())
        near &= may_hit_ball<Shared>(filter.ball, rays, scale, t_end);
    return near == 0 ? QuadricCrossing{0, 0}
                     : crossing_of<Query, Shared>(filter, rays, scale, t_end, near);
}

/// Where half a packet crosses a quadric beyond t_min: roots 0 and 1 are the side's, 2 and 3 the
/// caps'.
struct HalfCrossings {
    vreal<double> t[4] = {vreal<double>(0.0), vreal<double>(0.0), vreal<double>(0.0),
                          vreal<double>(0.0)};
    std::uint32_t valid[4] = {};
};

[[gnu::noinline]] inline HalfCrossings half_crossings(const abi::QuadricRecord<double>& quadric,
                                                      const RayPacket<double>& rays)
{
    HalfCrossings result;
    int sides = 0;
    visit_crossings(quadric, quadric_origin<double>(quadric, rays.org), rays,
                    [&](vmask<double> valid, const vreal<double>& t, int piece) {
                        const int at = piece == 0 ? sides++ : piece + 1;
                        result.t[at] = t;
                        result.valid[at] |= bits(valid & (t > rays.t_min));
                    });
    return result;
}

/// Calls `visit(lanes, low, high, piece)` for the crossings beyond t_min of the lanes of `active`.
template <class Visit>
inline void visit_in_double(const abi::QuadricRecord<double>& quadric, const RayPacket<float>& rays,
                            std::uint32_t active, const Visit& visit)
{
    HalfCrossings low;
    HalfCrossings high;
    if ((active & all_lanes<double>) != 0)
        low = half_crossings(quadric, widen_low(rays));
    if (active >> lanes<double> != 0)
        high = half_crossings(quadric, widen_high(rays));
    for (int at = 0; at < 4; ++at) {
        const std::uint32_t valid = narrow_bits(low.valid[at], high.valid[at]) & active;
        if (valid == 0)
            continue;
        const vreal<float> t = narrow(low.t[at], high.t[at]);
        visit(valid, rounded_low(t), rounded_high(t), at < 2 ? 0 : at - 1);
    }
}

/// What may hit is tested in double.
template <bool Shared, class Own>
inline void keep_certain(HitPacket<float>& hit, const QuadricFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const std::uint32_t active =
        certain_crossing<QuadricQuery::closest, Shared>(filter, rays, scale, hit.t, own).left;
    if (active == 0)
        return;
    const std::int32_t side = filter.record->surface;
    visit_in_double(
        *filter.wide, rays, active,
        [&](std::uint32_t lanes_of, const vreal<float>& low, const vreal<float>& high, int piece) {
            keep_sure(hit, from_bits<float>(lanes_of), low, high, side + piece);
        });
}

/// What any piece does to the lanes that do not start on it.
template <bool Shared, class Own>
inline Occlusion occludes(const QuadricFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own& own)
{
    const QuadricCrossing crossing =
        certain_crossing<QuadricQuery::occlusion, Shared>(filter, rays, scale, t_end, own);
    Occlusion result{crossing.blocked, 0};
    if (crossing.left == 0)
        return result;
    visit_in_double(
        *filter.wide, rays, crossing.left,
        [&](std::uint32_t lanes_of, const vreal<float>& low, const vreal<float>& high, int) {
            const Occlusion at = root_between(low, high, lanes_of, rays.t_min, t_end);
            result.blocked |= at.blocked;
            result.unsure |= at.unsure;
        });
    result.unsure &= ~result.blocked;
    return result;
}

/// The kind (kinds.hpp).
struct Quadric : KindOf<abi::Primitive::quadric, abi::SurfaceKind::quadric_side, 3, true> {
    template <class Real>
    using FromPoint = ObjectArray<SharedOriginQuadric<Real>>;
    using Certain = ObjectArray<QuadricFilter>;

    template <class Real>
    static const auto& list(const abi::GeometryView<Real>& scene)
    {
        return scene.quadrics;
    }
    static const auto* shapes(const abi::ShapesView& shapes)
    {
        return shapes.quadrics;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
