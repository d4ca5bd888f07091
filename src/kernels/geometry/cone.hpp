#pragma once

#include "kernels/geometry/packet.hpp"
#include "kernels/simd/vfloat8.hpp"

// A bound of many rays: their directions lie in a cone around an axis, their origins in a ball. It
// tells which objects none of the rays can hit.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct Cone {
    Real base[3] = {};  ///< centre of the ball of origins
    Real radius = 0;    ///< of that ball
    Real axis[3] = {};  ///< unit to rounding
    Real sine = 0;      ///< of the cone's half angle, which is below a right angle
    Real cosine = 1;
    Real reach = 0;        ///< all rays end within this distance of the base; may be infinite
    bool bounded = false;  ///< false: directions are not bounded, and no object can be skipped
};

template <class Real>
inline Real square_root(Real x)
{
    return static_cast<Real>(__builtin_sqrt(static_cast<double>(x)));
}

template <class Real>
inline Real magnitude(Real x)
{
    return x < 0 ? -x : x;
}

/// The share of a length by which a bound may be wrong through rounding. It is more than three
/// times what the operations below and a ray's own test can lose (proof in
/// docs/numerics_derivations.md). So a sphere is skipped only if both the exact and the rounded
/// test of every ray miss it.
template <class Real>
inline constexpr Real cone_slack = sizeof(Real) == 4 ? Real(1e-5) : Real(1e-13);

/// A larger reach counts as infinite.
template <class Real>
inline constexpr Real largest_reach = Real(1e18);

/// Lanes whose sphere may be hit by a ray of the cone. `v` leads from the cone's base to the
/// sphere's centre.
template <class Real>
inline vmask<Real> may_meet(const Cone<Real>& cone, const Vec3v<Real>& v, const vreal<Real>& radius)
{
    const Vec3v<Real> axis = broadcast(cone.axis);
    const vreal<Real> distance = sqrt(dot(v, v));
    const vreal<Real> along = dot(v, axis);
    const Vec3v<Real> moment = cross(v, axis);
    const vreal<Real> across = sqrt(dot(moment, moment));

    const vreal<Real> slack = vreal<Real>(cone_slack<Real>) * (distance + radius);
    const vreal<Real> size = radius + vreal<Real>(cone.radius) + slack;
    const vreal<Real> outside =
        msub(across, vreal<Real>(cone.cosine), along * vreal<Real>(cone.sine));
    return (outside <= size) & (along >= negated(size)) &
           (distance <= (vreal<Real>(cone.reach) + size));
}

/// Whether all directions are more than a right angle away from `direction`, by more than rounding
/// errors.
template <class Real>
inline bool runs_against(const Cone<Real>& cone, const Real (&direction)[3])
{
    Real along = 0;
    Real length2 = 0;
    for (int i = 0; i < 3; ++i) {
        along += cone.axis[i] * direction[i];
        length2 += direction[i] * direction[i];
    }
    return cone.bounded && along < -(cone.sine + cone_slack<Real>)*square_root(length2);
}

template <class Real>
struct Ball {
    Real center[3];
    Real radius;
};

/// A ball that contains the ends of the rays of a cone made by segment_cone().
template <class Real>
inline Ball<Real> far_end(const Cone<Real>& cone)
{
    const Real distance = cone.reach / (Real(1) + cone.sine);
    Ball<Real> ball;
    for (int i = 0; i < 3; ++i)
        ball.center[i] = cone.base[i] + distance * cone.axis[i];
    ball.radius = distance * cone.sine;
    return ball;
}

/// Whether a ball is completely in front of a plane with a unit normal, by more than rounding
/// errors.
template <class Real>
inline bool is_in_front(const Ball<Real>& ball, const Real (&point)[3], const Real (&normal)[3])
{
    Real height = 0;
    Real size = ball.radius;
    for (int i = 0; i < 3; ++i) {
        height += normal[i] * (ball.center[i] - point[i]);
        size += magnitude(ball.center[i]) + magnitude(point[i]);
    }
    return height > ball.radius + cone_slack<Real> * size;
}

/// Whether every ray of a cone stays in front of a plane: it starts there, and either runs away
/// from the plane or ends before it.
template <class Real>
inline bool stays_in_front(const Cone<Real>& cone, const Real (&point)[3], const Real (&normal)[3])
{
    if (!cone.bounded ||
        !is_in_front<Real>({{cone.base[0], cone.base[1], cone.base[2]}, cone.radius}, point,
                           normal))
        return false;
    const Real towards[3] = {-normal[0], -normal[1], -normal[2]};
    return runs_against(cone, towards) || (cone.radius == 0 && cone.reach < largest_reach<Real> &&
                                           is_in_front(far_end(cone), point, normal));
}

// Bounding boxes of points, and the cones of shadow rays from a light to them, or from them along a
// direction.

template <class Real>
struct Box {
    Real low[3];
    Real high[3];
};

/// The largest lane of a packet.
template <class Real>
inline Real largest_lane(batch<Real> x)
{
    alignas(64) Real value[lanes<Real>];
    store(value, x);
    if constexpr (sizeof(Real) == sizeof(float) && lanes<Real> % 8 == 0) {
        vfloat8 most = load8(value);
        for (int first = 8; first < lanes<Real>; first += 8)
            most = max(most, load8(value + first));
        return largest_of8(most);
    } else {
        Real most = value[0];
        for (int lane = 1; lane < lanes<Real>; ++lane)
            most = value[lane] > most ? value[lane] : most;
        return most;
    }
}

/// The smallest lane of one packet and the largest lane of another.
template <class Real>
inline void extent_of_lanes(batch<Real> smallest, batch<Real> largest, Real& low, Real& high)
{
    low = -largest_lane<Real>(negated(smallest));
    high = largest_lane<Real>(largest);
}

/// The bounding box of points that are added in packets.
template <class Real>
class PacketBox {
public:
    void add(const Vec3v<Real>& points)
    {
        low_ = {min(low_.x, points.x), min(low_.y, points.y), min(low_.z, points.z)};
        high_ = {max(high_.x, points.x), max(high_.y, points.y), max(high_.z, points.z)};
    }

    [[nodiscard]] Box<Real> box() const
    {
        Box<Real> box;
        extent_of_lanes<Real>(low_.x, high_.x, box.low[0], box.high[0]);
        extent_of_lanes<Real>(low_.y, high_.y, box.low[1], box.high[1]);
        extent_of_lanes<Real>(low_.z, high_.z, box.low[2], box.high[2]);
        return box;
    }

private:
    static vreal<Real> never()
    {
        return vreal<Real>(static_cast<Real>(__builtin_inf()));
    }

    Vec3v<Real> low_{never(), never(), never()};
    Vec3v<Real> high_{negated(never()), negated(never()), negated(never())};
};

/// The smallest and largest of `count` > 0 values.
template <class Real>
inline void extent(const Real* values, int count, Real& low, Real& high)
{
    vreal<Real> smallest(values[0]);
    vreal<Real> largest = smallest;
    int i = 0;
    for (; i + lanes<Real> <= count; i += lanes<Real>) {
        smallest = min(smallest, load(values + i));
        largest = max(largest, load(values + i));
    }
    if (i < count) {
        const auto active = from_bits<Real>(first_lanes<Real>(count - i));
        smallest = select(active, min(smallest, load(values + i)), smallest);
        largest = select(active, max(largest, load(values + i)), largest);
    }
    extent_of_lanes<Real>(smallest, largest, low, high);
}

/// The bounding box of `count` > 0 points.
template <class Real, std::size_t Length>
inline Box<Real> box_of(const Real (&points)[3][Length], int count)
{
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis)
        extent(points[axis], count, box.low[axis], box.high[axis]);
    return box;
}

/// The ball around a box, enlarged for rounding errors of coordinates of that size: those of its
/// centre, and the offsets of rays that start off the points in the box.
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
    ball.radius = square_root(radius2) + cone_slack<Real> * size;
    return ball;
}

/// The cone of parallel rays from the points in `box`.
template <class Real>
inline Cone<Real> parallel_cone(const Real (&direction)[3], const Box<Real>& box)
{
    const Ball<Real> ball = ball_around(box);
    Cone<Real> cone;
    Real length2 = 0;
    for (int axis = 0; axis < 3; ++axis)
        length2 += direction[axis] * direction[axis];
    const Real length = square_root(length2);
    for (int axis = 0; axis < 3; ++axis) {
        cone.base[axis] = ball.center[axis];
        cone.axis[axis] = direction[axis] / length;
    }
    cone.radius = ball.radius;
    cone.reach = static_cast<Real>(__builtin_inf());
    cone.bounded = true;
    return cone;
}

/// The cone of rays from a point light to the points in `box`, by the ball around the box.
template <class Real>
inline Cone<Real> segment_cone(const Real (&light)[3], const Box<Real>& box)
{
    const Ball<Real> ball = ball_around(box);
    Cone<Real> cone;
    Real distance2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        cone.base[axis] = light[axis];
        cone.axis[axis] = ball.center[axis] - light[axis];
        distance2 += cone.axis[axis] * cone.axis[axis];
    }
    const Real distance = square_root(distance2);
    const Real radius = ball.radius + cone_slack<Real> * distance;
    cone.bounded = radius < distance;
    if (!cone.bounded)
        return cone;
    for (Real& component : cone.axis)
        component /= distance;
    cone.sine = radius / distance;
    cone.cosine = square_root((distance - radius) * (distance + radius)) / distance;
    cone.reach = distance + radius;
    return cone;
}

/// The cone of rays from the points in `box` to a point; not bounded if the point is inside the
/// ball around the box.
template <class Real>
inline Cone<Real> cone_to(const Real (&point)[3], const Box<Real>& box)
{
    const Ball<Real> ball = ball_around(box);
    Cone<Real> cone = segment_cone(point, box);
    for (int axis = 0; axis < 3; ++axis) {
        cone.base[axis] = ball.center[axis];
        cone.axis[axis] = -cone.axis[axis];
    }
    cone.radius = ball.radius;
    return cone;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
