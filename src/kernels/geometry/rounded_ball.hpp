#pragma once

#include "kernels/geometry/kinds.hpp"

// Bounding balls of objects in single precision, and how far rounding moved their centres.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// |x| + |y| + |z|, no less than the length.
inline double size_of(const float (&v)[3])
{
    return __builtin_fabs(double{v[0]}) + __builtin_fabs(double{v[1]}) +
           __builtin_fabs(double{v[2]});
}

/// A ball in single precision that contains an object; its centre is off by at most `error`.
struct RoundedBall {
    float center[3];
    float radius;
    float error;
    Body body;
};

inline RoundedBall ball_of(const abi::SphereListView<float>& list, int i)
{
    return {{list.center_x[i], list.center_y[i], list.center_z[i]},
            list.radius[i],
            list.center_error[i],
            {list.surface[i]}};
}

/// The ball around a quadric (of infinite radius if it is unbounded) or around a polygon.
template <class Record>
inline RoundedBall ball_of(const Record& record)
{
    RoundedBall ball{{}, record.bound_radius * inflation, 0, body_of(record)};
    double size = 0;
    for (int axis = 0; axis < 3; ++axis) {
        ball.center[axis] = static_cast<float>(record.bound[axis]);
        size += __builtin_fabs(double{ball.center[axis]});
    }
    // The exact centre of the ball was rounded once.
    ball.error = above(size * 0x1p-23);
    return ball;
}

/// Calls `visit(record)` for the objects of a scene that are neither spheres nor planes: quadrics,
/// then polygons.
template <class Real, class Visit>
inline void for_each_other(const abi::GeometryView<Real>& scene, const Visit& visit)
{
    for (int i = 0; i < scene.quadrics.count; ++i)
        visit(scene.quadrics.data[i]);
    for (int i = 0; i < scene.polygons.count; ++i)
        visit(scene.polygons.data[i]);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
