#pragma once

#include "kernels/geometry/sphere_filter.hpp"

// Bounding balls of objects whose own test is expensive: which rays in single precision certainly
// miss the ball.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A ball for a set of ray origins.
struct BallFilter {
    float center[3];  ///< for a shared origin: from the centre to the origin
    float outer2;     ///< squared radius including all errors; infinite for an unbounded object
    float reach;      ///< upper bound of half the length of a ray inside the ball, times |d|
};

template <Origin O>
inline BallFilter ball_filter(const double (&center)[3], float radius, const Origins& origins)
{
    BallFilter ball{};
    double distance2 = 0;
    float moved_by = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double to_ball = double{origins.center[axis]} - center[axis];
        distance2 += to_ball * to_ball;
        ball.center[axis] = static_cast<float>(O == Origin::shared ? to_ball : center[axis]);
        const double moved =
            double{ball.center[axis]} - (O == Origin::shared ? to_ball : center[axis]);
        moved_by += static_cast<float>(moved < 0 ? -moved : moved);
    }
    const float distance =
        (static_cast<float>(__builtin_sqrt(distance2)) + origins.radius) * inflation;
    const vreal<float> center_error(moved_by * inflation);
    const SphereBounds<vreal<float>> bounds =
        sphere_bounds(vreal<float>(radius * inflation), center_error,
                      moment_error(center_error, vreal<float>(distance)));
    ball.outer2 = first_lane<float>(bounds.outer2);
    ball.reach = first_lane<float>(bounds.reach);
    return ball;
}

/// Lanes that may be inside the ball between t_min and t_end.
template <Origin O>
inline std::uint32_t may_hit_ball(const BallFilter& ball, const RayPacket<float>& rays,
                                  const RayScale& scale, const vreal<float>& t_end)
{
    const Vec3v<float> w =
        O == Origin::shared ? broadcast(ball.center) : rays.org - broadcast(ball.center);
    const std::uint32_t near = approach(w, vreal<float>(ball.outer2), rays).near;
    if (near == 0)
        return 0;
    const vreal<float> middle = negated(dot(w, rays.dir)) * scale.inverse2;
    return may_be_within(near, middle, vreal<float>(ball.reach), rays, scale, t_end);
}

/// The same for a ball that may be infinite, without the lanes that start on the object in it. Most
/// packets miss the ball, so the lanes that start on the object are looked up last.
template <Origin O, class Own>
inline std::uint32_t others_near_ball(const BallFilter& ball, const Body& body,
                                      const RayPacket<float>& rays, const RayScale& scale,
                                      const vreal<float>& t_end, const Own& own)
{
    std::uint32_t near = all_lanes<float>;
    if (ball.outer2 < __builtin_inff())
        near = may_hit_ball<O>(ball, rays, scale, t_end);
    return near == 0 ? 0 : near & own.template lanes_on_others<float>(body.first, body.pieces);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
