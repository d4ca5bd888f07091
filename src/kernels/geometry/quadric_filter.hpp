#pragma once

#include "kernels/geometry/ball_filter.hpp"
#include "kernels/geometry/quadric.hpp"
#include "kernels/geometry/quadric_body.hpp"
#include "kernels/geometry/quadric_place.hpp"

// Quadrics for rays in single precision: a certain rejection, and behind it the test in double,
// two half packets at a time.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A quadric for the origins of one group.
struct QuadricFilter {
    const abi::QuadricRecord<float>* record;
    const abi::QuadricRecord<double>* wide;
    float p[3];                ///< a shared origin in canonical space, rounded once from double
    float height;              ///< and in the space that clipping goes by
    BallFilter ball;           ///< around it; infinite for an unbounded quadric
    float discriminant_error;  ///< at most, per d·d, of rays that come near the ball
    float slope_error;         ///< of b, per |d|
    float bend_error;          ///< of a, per d·d
    float climb_error;         ///< of a height, per |d| and t
    // The clipping planes, moved outwards and inwards by the error of the origin's height.
    float outer_low, outer_high;
    float inner_low, inner_high;
};

inline float row_length(const float (&row)[3])
{
    return __builtin_sqrtf(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]) * inflation;
}

inline float square_error(float x, float dx)
{
    return (2 * x + dx) * dx + roundoffs(9.0f) * x * x;
}
inline float product_error(float x, float dx, float y, float dy)
{
    return x * dy + y * dx + dx * dy + roundoffs(9.0f) * x * y;
}

/// Bounds below this may have lost terms to underflow, and say nothing.
inline constexpr float smallest_error = 0x1p-90f;

/// Lengths that enter the bounds.
struct QuadricLengths {
    float row[3];   ///< of the rows of the inverse
    float reach;    ///< from the centre to any origin, at most
    float passing;  ///< from the centre to any ray that comes near the ball, at most
};

/// What v is off by, per |d|.
inline float dir_error(const QuadricLengths& lengths, int axis)
{
    return roundoffs(4.2f) * lengths.row[axis];
}

inline QuadricLengths lengths_of(const QuadricFilter& filter, double to_center, float radius)
{
    QuadricLengths lengths{};
    double to_bound2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        lengths.row[axis] = row_length(filter.record->inverse[axis]);
        const double to_bound = filter.wide->bound[axis] - filter.wide->center[axis];
        to_bound2 += to_bound * to_bound;
    }
    lengths.reach = (static_cast<float>(to_center) + radius) * inflation;
    const float near_ball = filter.ball.reach + roundoffs(4.0f) * lengths.reach +
                            static_cast<float>(__builtin_sqrt(to_bound2)) * inflation;
    lengths.passing = min(lengths.reach, near_ball);
    return lengths;
}

/// By the largest |v| and |m| = |p × v| there are.
inline float discriminant_error(const abi::QuadricRecord<float>& quadric,
                                const QuadricLengths& lengths)
{
    float size[3];
    float moment[3];
    float moment_error[3];
    for (int axis = 0; axis < 3; ++axis) {
        const float rows = lengths.row[(axis + 1) % 3] * lengths.row[(axis + 2) % 3];
        size[axis] = magnitude(quadric.square[axis]);
        moment[axis] = rows * lengths.passing;
        moment_error[axis] = roundoffs(26.0f) * rows * lengths.reach;
    }
    float error = 0;
    for (int axis = 0; axis < 3; ++axis) {
        error += size[(axis + 1) % 3] * size[(axis + 2) % 3] *
                 square_error(moment[axis], moment_error[axis]);
        error += magnitude(quadric.constant) * size[axis] *
                 square_error(lengths.row[axis], dir_error(lengths, axis));
    }
    const float linear = magnitude(quadric.linear);
    if (linear > 0) {
        for (int axis = 0; axis < 2; ++axis)
            error += 2 * linear * size[1 - axis] *
                     product_error(lengths.row[1 - axis], dir_error(lengths, 1 - axis),
                                   moment[axis], moment_error[axis]);
        error += linear * linear * square_error(lengths.row[2], dir_error(lengths, 2));
    }
    return error * inflation;
}

/// The errors of what tells where along a ray the unclipped side is, at most.
inline void set_range_errors(QuadricFilter& filter, const QuadricLengths& lengths)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    float slope =
        magnitude(quadric.linear) * (dir_error(lengths, 2) + roundoffs(9.0f) * lengths.row[2]);
    float bend = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float size = magnitude(quadric.square[axis]);
        const float place = lengths.row[axis] * lengths.reach;
        slope += size * product_error(place, roundoffs(6.2f) * place, lengths.row[axis],
                                      dir_error(lengths, axis));
        bend += size * square_error(lengths.row[axis], dir_error(lengths, axis));
    }
    filter.slope_error = slope > smallest_error ? slope * inflation : __builtin_inff();
    filter.bend_error = bend * inflation;
}

/// Those of heights.
inline void set_clip_errors(QuadricFilter& filter, const QuadricLengths& lengths)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    const float clip = row_length(quadric.clip);
    filter.climb_error = roundoffs(7.0f) * clip;
    const float height =
        roundoffs(10.0f) * clip * lengths.reach + roundoffs(5.0f) * magnitude(quadric.clip_offset);
    const auto moved = [&](float plane, float by) {
        return plane + by * (height + roundoffs(4.0f) * magnitude(plane));
    };
    const bool has_low = quadric.clip_low > -__builtin_inff();
    const bool has_high = quadric.clip_high < __builtin_inff();
    filter.outer_low = moved(quadric.clip_low, -1.0f);
    filter.inner_low = has_low ? moved(quadric.clip_low, 1.0f) : quadric.clip_low;
    filter.outer_high = moved(quadric.clip_high, 1.0f);
    filter.inner_high = has_high ? moved(quadric.clip_high, -1.0f) : quadric.clip_high;
}

template <bool Shared>
[[gnu::noinline]] QuadricFilter quadric_filter(const abi::QuadricRecord<float>& record,
                                               const abi::QuadricRecord<double>& wide,
                                               const Origins& origins)
{
    QuadricFilter filter{};
    filter.record = &record;
    filter.wide = &wide;
    filter.ball = ball_filter<Shared>(wide.bound, record.bound_radius, origins);
    double distance2 = 0;
    double height = wide.clip_offset;
    double w[3];
    for (int axis = 0; axis < 3; ++axis) {
        w[axis] = double{origins.center[axis]} - wide.center[axis] - wide.center_low[axis];
        distance2 += w[axis] * w[axis];
        height += wide.clip[axis] * w[axis];
    }
    for (int axis = 0; Shared && axis < 3; ++axis)
        filter.p[axis] =
            static_cast<float>(wide.inverse[axis][0] * w[0] + wide.inverse[axis][1] * w[1] +
                               wide.inverse[axis][2] * w[2]);
    filter.height = static_cast<float>(height);
    const QuadricLengths lengths = lengths_of(filter, __builtin_sqrt(distance2), origins.radius);
    filter.discriminant_error = discriminant_error(record, lengths);
    set_range_errors(filter, lengths);
    set_clip_errors(filter, lengths);
    return filter;
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
    const Body body = body_of(*filter.record);
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

inline Body body_of(const QuadricFilter& quadric)
{
    return body_of(*quadric.record);
}

template <bool Shared>
inline QuadricFilter certain_form(const abi::QuadricRecord<float>& record,
                                  const abi::QuadricRecord<double>& wide, const Origins& origins)
{
    return quadric_filter<Shared>(record, wide, origins);
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
struct Quadric {
    static constexpr abi::Primitive primitive = abi::Primitive::quadric;
    static constexpr abi::SurfaceKind first_surface = abi::SurfaceKind::quadric_side;
    static constexpr unsigned surfaces = 3;
    template <class Real>
    using FromPoint = ObjectArray<SharedOriginQuadric<Real>>;
    using Certain = ObjectArray<QuadricFilter>;

    static constexpr bool in(abi::Features features)
    {
        return features.quadrics;
    }
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
