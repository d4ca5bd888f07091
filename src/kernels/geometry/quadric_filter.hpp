#pragma once

#include "kernels/geometry/quadric_body.hpp"
#include "kernels/geometry/quadric_place.hpp"
#include "kernels/geometry/quadric_roots.hpp"

// Quadrics for rays in single precision: the tests with error bounds, and for lanes that they
// cannot decide the test in double, by half packets.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline Body body_of(const QuadricFilter& quadric)
{
    return quadric.body;
}

/// What a test of a quadric searches for.
enum class QuadricQuery { closest, occlusion };

/// The result of the test in single precision.
struct QuadricCrossing {
    std::uint32_t crossed = 0;  ///< lanes that certainly hit it between t_min and t_end
    std::uint32_t left = 0;     ///< other lanes that may; they are tested in double
    vreal<float> low, high;     ///< for closest hits: where the lanes of `crossed` hit it first
};

/// Decides lanes of `near` by their two roots.
template <QuadricQuery Query>
inline void cross_by_roots(QuadricCrossing& crossing, const QuadricFilter& filter,
                           const SideRoots& roots, const ClipHeights& heights,
                           const vreal<float>& t_min, const vreal<float>& t_end, std::uint32_t near)
{
    constexpr bool wants_first = Query == QuadricQuery::closest;
    const bool capped = filter.record->capped;
    const SideRoot first =
        side_root(filter, heights, roots.low, roots.low + roots.width, t_min, t_end);
    // A ray enters a capped quadric by the first root, if that is between the planes.
    const std::uint32_t enters = wants_first && capped ? roots.convex : roots.crosses;
    crossing.crossed = near & roots.crosses & enters & first.counts;
    crossing.low = first.low;
    crossing.high = first.high;
    crossing.left = near & ~crossing.crossed;
    const std::uint32_t open = crossing.left & roots.crosses;
    if (open == 0 || (wants_first && capped))
        return;
    const SideRoot second =
        side_root(filter, heights, roots.high - roots.width, roots.high, t_min, t_end);
    const std::uint32_t by_second = open & second.counts & (wants_first ? first.gone : open);
    crossing.crossed |= by_second;
    crossing.left &= ~by_second;
    if constexpr (wants_first) {
        const vmask<float> further = from_bits<float>(by_second);
        crossing.low = select(further, second.low, crossing.low);
        crossing.high = select(further, second.high, crossing.high);
    }
    if (!capped)
        crossing.left &= ~(open & first.gone & second.gone);
}

template <QuadricQuery Query, Origin O>
[[gnu::noinline]] QuadricCrossing crossing_of(const QuadricFilter& filter,
                                              const RayPacket<float>& rays, const RayScale& scale,
                                              const vreal<float>& t_end, std::uint32_t near)
{
    const QuadricLine line = line_of<O>(filter, rays);
    QuadricCrossing crossing;
    near &= ~surely_misses(filter, line, rays);
    if (near == 0)
        return crossing;
    const SideRoots roots = side_roots(filter, line, rays, scale);
    crossing.left = near;
    if (roots.bent == 0)
        return crossing;
    const ClipHeights heights(filter, line, rays, scale);
    near &= ~((filter.record->capped ? roots.convex : roots.bent) &
              surely_passes(filter, roots, heights, rays.t_min, t_end));
    crossing.left = near;
    if ((near & roots.crosses) != 0)
        cross_by_roots<Query>(crossing, filter, roots, heights, rays.t_min, t_end, near);
    return crossing;
}

/// The same, without the lanes whose rays start on the quadric.
template <QuadricQuery Query, Origin O, class Own>
inline QuadricCrossing certain_crossing(const QuadricFilter& filter, const RayPacket<float>& rays,
                                        const RayScale& scale, const vreal<float>& t_end,
                                        const Own& own)
{
    const std::uint32_t near =
        others_near_ball<O>(filter.ball, filter.body, rays, scale, t_end, own);
    return near == 0 ? QuadricCrossing{} : crossing_of<Query, O>(filter, rays, scale, t_end, near);
}

/// The hits of half a packet with a quadric beyond t_min. Roots 0 and 1 are those of the side, 2
/// and 3 those of the caps.
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

/// Calls `visit(lanes, low, high, piece)` for the hits beyond t_min of the lanes of `active`, found
/// in double.
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

/// Lanes that may hit, but are not certain, are tested in double.
template <Origin O, class Own>
inline void keep_certain(HitPacket<float>& hit, const QuadricFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const QuadricCrossing crossing =
        certain_crossing<QuadricQuery::closest, O>(filter, rays, scale, hit.t, own);
    const std::int32_t side = filter.record->surface;
    if (crossing.crossed != 0)
        keep_sure(hit, from_bits<float>(crossing.crossed), crossing.low, crossing.high, side);
    if (crossing.left == 0)
        return;
    visit_in_double(
        *filter.wide, rays, crossing.left,
        [&](std::uint32_t lanes_of, const vreal<float>& low, const vreal<float>& high, int piece) {
            keep_sure(hit, from_bits<float>(lanes_of), low, high, side + piece);
        });
}

/// The lanes that any piece occludes, without those that start on the quadric.
template <Origin O, class Own>
inline Occlusion occludes(const QuadricFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own& own)
{
    const QuadricCrossing crossing =
        certain_crossing<QuadricQuery::occlusion, O>(filter, rays, scale, t_end, own);
    Occlusion result{crossing.crossed, 0};
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

/// The kind, see kinds.hpp.
struct Quadric
    : KindOf<abi::Primitive::quadric, abi::SurfaceKind::quadric_side, 3, CompiledFor::quadrics> {
    template <class Real>
    using FromPoint = ObjectArray<SharedOriginQuadric<Real>>;
    template <class Real>
    using Selected = SelectedRecords<abi::QuadricRecord<Real>>;
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
