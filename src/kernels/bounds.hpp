#pragma once

#include "kernels/beam.hpp"

// Bounds of a stream's points, and the beams of shadow rays towards or along them.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct Box {
    Real low[3];
    Real high[3];
};

/// The least of the lanes of one packet and the most of another's.
template <class Real>
inline void extent_of_lanes(batch<Real> smallest, batch<Real> largest, Real& low, Real& high)
{
    alignas(64) Real smallest_lanes[lanes<Real>];
    alignas(64) Real largest_lanes[lanes<Real>];
    store(smallest_lanes, smallest);
    store(largest_lanes, largest);
    low = smallest_lanes[0];
    high = largest_lanes[0];
    for (int lane = 1; lane < lanes<Real>; ++lane) {
        low = smallest_lanes[lane] < low ? smallest_lanes[lane] : low;
        high = largest_lanes[lane] > high ? largest_lanes[lane] : high;
    }
}

template <class Real>
inline void extent(const Real* values, int count, Real& low, Real& high)
{
    // Lanes beyond the end repeat the first value.
    const vreal<Real> first(values[0]);
    vreal<Real> smallest = first;
    vreal<Real> largest = first;
    for (int i = 0; i < count; i += lanes<Real>) {
        const auto active = from_bits<Real>(first_lanes<Real>(count - i));
        const vreal<Real> value = select(active, load(values + i), first);
        smallest = min(smallest, value);
        largest = max(largest, value);
    }
    extent_of_lanes<Real>(smallest, largest, low, high);
}

/// `count` > 0.
template <class Real, std::size_t Size>
inline Box<Real> box_of(const Real (&points)[3][Size], int count)
{
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis)
        extent(points[axis], count, box.low[axis], box.high[axis]);
    return box;
}

template <class Real>
struct Ball {
    Real center[3];
    Real radius;
};

/// The ball around a box, with room for what rounding does to coordinates as large as its own:
/// to its centre, and to rays that start lifted off the points in it.
template <class Real>
inline Ball<Real> ball_around(const Box<Real>& box)
{
    Ball<Real> ball;
    Real radius2 = 0;
    Real size = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Real half = Real(0.5) * (box.high[axis] - box.low[axis]);
        ball.center[axis] = box.low[axis] + half;
        radius2 += half * half;
        size += magnitude(ball.center[axis]) + half;
    }
    ball.radius = square_root(radius2) + beam_slack<Real> * size;
    return ball;
}

/// From everything in `box` along `direction`.
template <class Real>
inline Beam<Real> parallel_beam(const Real (&direction)[3], const Box<Real>& box)
{
    const Ball<Real> ball = ball_around(box);
    Beam<Real> beam;
    Real length2 = 0;
    for (int axis = 0; axis < 3; ++axis)
        length2 += direction[axis] * direction[axis];
    const Real length = square_root(length2);
    for (int axis = 0; axis < 3; ++axis) {
        beam.base[axis] = ball.center[axis];
        beam.axis[axis] = direction[axis] / length;
    }
    beam.radius = ball.radius;
    beam.reach = static_cast<Real>(__builtin_inf());
    beam.bounded = true;
    return beam;
}

/// From a point light to everything in `box`: a cone around the ball that holds the box.
template <class Real>
inline Beam<Real> segment_beam(const Real (&light)[3], const Box<Real>& box)
{
    const Ball<Real> ball = ball_around(box);
    Beam<Real> beam;
    Real distance2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        beam.base[axis] = light[axis];
        beam.axis[axis] = ball.center[axis] - light[axis];
        distance2 += beam.axis[axis] * beam.axis[axis];
    }
    const Real distance = square_root(distance2);
    const Real radius = ball.radius + beam_slack<Real> * distance;
    beam.bounded = radius < distance;
    if (!beam.bounded)
        return beam;
    for (Real& component : beam.axis)
        component /= distance;
    beam.sine = radius / distance;
    beam.cosine = square_root((distance - radius) * (distance + radius)) / distance;
    beam.reach = distance + radius;
    return beam;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
