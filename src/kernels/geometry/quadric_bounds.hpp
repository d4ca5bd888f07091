#pragma once

#include "kernels/geometry/ball_filter.hpp"
#include "kernels/geometry/quadric.hpp"

// A quadric with the error bounds for a set of rays.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A quadric for a set of ray origins.
struct QuadricFilter {
    const abi::QuadricRecord<float>* record;
    const abi::QuadricRecord<double>* wide;
    Body body;
    float p[3];                ///< a shared origin in canonical space, rounded once from double
    float height;              ///< its height in the space that clipping uses
    BallFilter ball;           ///< ball around it; infinite for an unbounded quadric
    float discriminant_error;  ///< upper bound, per d·d, for rays that pass close to the ball
    float slope_error;         ///< of b, per |d|
    float bend_error;          ///< of a, per d·d
    float climb_error;         ///< of a height, per |d| and t
    // The clipping planes, moved outwards and inwards by the error of the origin's height.
    float outer_low, outer_high;
    float inner_low, inner_high;
};

inline float square_error(float x, float dx)
{
    return (2 * x + dx) * dx + roundoffs(9.0f) * x * x;
}
inline float product_error(float x, float dx, float y, float dy)
{
    return x * dy + y * dx + dx * dy + roundoffs(9.0f) * x * y;
}

/// Bounds below this may have lost terms to underflow, and are not used.
inline constexpr float smallest_error = 0x1p-90f;

/// Upper bound of the distance from any origin to a point; `distance` is that of the origins'
/// centre.
inline float reach_of(const Origins& origins, double distance)
{
    return (static_cast<float>(distance) + origins.radius) * inflation;
}

/// Lengths in the error bounds.
struct QuadricLengths {
    float reach;    ///< upper bound of the distance from the centre to any origin
    float passing;  ///< upper bound of the distance from the centre to any ray that passes close to
                    ///< the ball
};

inline QuadricLengths lengths_of(const QuadricFilter& filter, const Origins& origins,
                                 double to_center)
{
    const float reach = reach_of(origins, to_center);
    const float near_ball =
        filter.ball.reach + roundoffs(4.0f) * reach + filter.record->bound_distance * inflation;
    return {reach, min(reach, near_ball)};
}

/// Error of v, per |d| and length of a row.
inline constexpr float dir_error = roundoffs(4.2f);

/// The error of the discriminant, for the largest |v| and |m| = |p × v|.
inline float discriminant_error(const abi::QuadricRecord<float>& quadric,
                                const QuadricLengths& lengths)
{
    const float moment_error = roundoffs(26.0f) * lengths.reach;
    const float bend =
        magnitude(quadric.constant) * quadric.bend_size + quadric.lift_size * quadric.lift_size;
    return (quadric.moment_size * square_error(lengths.passing, moment_error) +
            bend * square_error(1.0f, dir_error) +
            quadric.turn_size * product_error(1.0f, dir_error, lengths.passing, moment_error)) *
           inflation;
}

/// Sets the error bounds of the terms that locate the unclipped side along a ray.
inline void set_range_errors(QuadricFilter& filter, const QuadricLengths& lengths)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    const float slope =
        quadric.lift_size * (dir_error + roundoffs(9.0f)) +
        quadric.bend_size *
            product_error(lengths.reach, roundoffs(6.2f) * lengths.reach, 1.0f, dir_error);
    filter.slope_error = slope > smallest_error ? slope * inflation : __builtin_inff();
    filter.bend_error = quadric.bend_size * square_error(1.0f, dir_error) * inflation;
}

/// Sets the error bounds of heights; `reach` is an upper bound of the distance from the origin of
/// heights to any ray origin.
inline void set_clip_errors(QuadricFilter& filter, float reach)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    filter.climb_error = roundoffs(7.0f) * quadric.clip_size;
    const float height = roundoffs(10.0f) * quadric.clip_size * reach;
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

template <Origin O>
[[gnu::noinline]] QuadricFilter certain_form(const abi::QuadricRecord<float>& record,
                                             const abi::QuadricRecord<double>& wide,
                                             const Origins& origins)
{
    QuadricFilter filter{};
    filter.record = &record;
    filter.wide = &wide;
    filter.body = body_of(record);
    filter.ball = ball_filter<O>(wide.bound, record.bound_radius, origins);
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
    for (int axis = 0; O == Origin::shared && axis < 3; ++axis)
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
