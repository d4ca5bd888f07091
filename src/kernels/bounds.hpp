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

/// `count` > 0.
template <class Real, std::size_t Size>
inline Box<Real> box_of(const Real (&points)[3][Size], int count)
{
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis)
        extent(points[axis], count, box.low[axis], box.high[axis]);
    return box;
}

/// From a point light to everything in `box`: a cone around the ball that holds the box.
template <class Real>
inline Beam<Real> segment_beam(const Real (&light)[3], const Box<Real>& box)
{
    Beam<Real> beam;
    Real distance2 = 0;
    Real radius2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Real half = Real(0.5) * (box.high[axis] - box.low[axis]);
        beam.base[axis] = light[axis];
        beam.axis[axis] = box.low[axis] + half - light[axis];
        distance2 += beam.axis[axis] * beam.axis[axis];
        radius2 += half * half;
    }
    const Real distance = square_root(distance2);
    const Real radius = square_root(radius2) + beam_slack<Real> * distance;
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
