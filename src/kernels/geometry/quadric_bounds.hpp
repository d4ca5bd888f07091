#pragma once

#include "kernels/geometry/ball_filter.hpp"
#include "kernels/geometry/quadric.hpp"

// A quadric with the error bounds of the rays of one group.
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

/// The distance from any origin to a place, at most.
inline float reach_of(const Origins& origins, double distance)
{
    return (static_cast<float>(distance) + origins.radius) * inflation;
}

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

inline QuadricLengths lengths_of(const QuadricFilter& filter, const Origins& origins,
                                 double to_center)
{
    QuadricLengths lengths{};
    double to_bound2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        lengths.row[axis] = row_length(filter.record->inverse[axis]);
        const double to_bound = filter.wide->bound[axis] - filter.wide->center[axis];
        to_bound2 += to_bound * to_bound;
    }
    lengths.reach = reach_of(origins, to_center);
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

/// Those of heights, `reach` being from where they begin to any origin, at most.
inline void set_clip_errors(QuadricFilter& filter, float reach)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    const float clip = row_length(quadric.clip);
    filter.climb_error = roundoffs(7.0f) * clip;
    const float height = roundoffs(10.0f) * clip * reach;
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
[[gnu::noinline]] QuadricFilter certain_form(const abi::QuadricRecord<float>& record,
                                             const abi::QuadricRecord<double>& wide,
                                             const Origins& origins)
{
    QuadricFilter filter{};
    filter.record = &record;
    filter.wide = &wide;
    filter.ball = ball_filter<Shared>(wide.bound, record.bound_radius, origins);
    double w[3];
    double distance2 = 0;
    double height = 0;
    double above_base2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        w[axis] = double{origins.center[axis]} - wide.center[axis];
        distance2 += w[axis] * w[axis];
        const double above_base = double{origins.center[axis]} - wide.clip_base[axis];
        height += wide.clip[axis] * above_base;
        above_base2 += above_base * above_base;
    }
    for (int axis = 0; Shared && axis < 3; ++axis)
        filter.p[axis] =
            static_cast<float>(wide.inverse[axis][0] * w[0] + wide.inverse[axis][1] * w[1] +
                               wide.inverse[axis][2] * w[2]);
    filter.height = static_cast<float>(height);
    const QuadricLengths lengths = lengths_of(filter, origins, __builtin_sqrt(distance2));
    filter.discriminant_error = discriminant_error(record, lengths);
    set_range_errors(filter, lengths);
    set_clip_errors(filter, reach_of(origins, __builtin_sqrt(above_base2)));
    return filter;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
