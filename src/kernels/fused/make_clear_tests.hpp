#pragma once

#include "kernels/fused/plan.hpp"

// Makes the quick tests for shadow rays of a frame (clear_way.hpp), and finds those that the points
// of each surface need. All bounds are computed in double, once per frame.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// How far the direction of a shadow ray may differ from the direction to the hit.
inline constexpr double clear_turn = 0x1p-9;
/// For that a point has to be further from a point light than this share of the scene's size.
inline constexpr double clear_distance = 1.0 / 1024.0;

/// Adds the plane through `point` with the unit normal `normal`, if the light is in front of it.
inline void add_front_plane(ClearTests& tests, const double (&point)[3], const double (&normal)[3],
                            const abi::LightRecord<float>& light, double extent,
                            std::int32_t behind)
{
    const bool is_point = light.kind == abi::LightKind::point;
    double size = extent;
    double level = 0;
    double height = 0;
    double length = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double x = light.vector[axis];
        level += normal[axis] * point[axis];
        height += normal[axis] * (is_point ? x - point[axis] : x);
        size += __builtin_fabs(x) + __builtin_fabs(point[axis]);
        length += __builtin_fabs(x);
    }
    const double slack = clear_slack * size;
    if (!(height > (is_point ? slack : clear_slack * length))) {
        tests.complete = false;
        return;
    }
    FrontPlane& plane = tests.planes.next();
    for (int axis = 0; axis < 3; ++axis)
        plane.normal[axis] = static_cast<float>(normal[axis]);
    plane.offset = above(level + slack + 0x1p-22 * __builtin_fabs(level));
    plane.behind = behind;
}

/// Adds planes that touch the anchored spheres, at the point closest to a point light or else to
/// the origins' centre.
inline void add_anchored(ClearTests& tests, const abi::SceneView<float>& casters,
                         const abi::LightRecord<float>& light, const Origins& origins,
                         double extent)
{
    const auto& list = casters.anchored_spheres;
    for (int i = 0; i < list.count; ++i) {
        const abi::SurfaceIndex& index = casters.shapes.index[list.data[i].surface];
        const abi::AnchoredSphere<double>& sphere = casters.shapes.anchored_spheres[index.record];
        double to[3];
        for (int axis = 0; axis < 3; ++axis)
            to[axis] = light.kind == abi::LightKind::point ? double{light.vector[axis]}
                                                           : double{origins.center[axis]};
        const double distance = distance_of(to, sphere.center);
        if (!(distance > sphere.radius)) {
            tests.complete = false;
            continue;
        }
        double normal[3];
        double point[3];
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis] = (to[axis] - sphere.center[axis]) / distance;
            point[axis] = sphere.center[axis] + sphere.radius * normal[axis];
        }
        add_front_plane(tests, point, normal, light, extent, sphere.surface);
    }
}

inline void add_planes(ClearTests& tests, const abi::SceneView<float>& casters,
                       const abi::LightRecord<float>& light, double extent)
{
    const auto& list = casters.planes;
    for (int i = 0; i < list.count; ++i) {
        const abi::SurfaceIndex& index = casters.shapes.index[list.data[i].surface];
        const abi::PlaneRecord<double>& plane = casters.shapes.planes[index.record];
        double height = 0;
        for (int axis = 0; axis < 3; ++axis)
            height += plane.normal[axis] * (light.kind == abi::LightKind::point
                                                ? double{light.vector[axis]} - plane.point[axis]
                                                : double{light.vector[axis]});
        const double side = height < 0 ? -1.0 : 1.0;
        const double normal[3] = {side * plane.normal[0], side * plane.normal[1],
                                  side * plane.normal[2]};
        add_front_plane(tests, plane.point, normal, light, extent, plane.surface);
    }
}

/// What a ball is: a sphere itself, the bounding ball of another object, or of another object that
/// is tested in fast mode. Those tests may find a hit behind the ball.
enum class BallOf { sphere, other, rough };

/// The ball around what the test of another object in fast mode takes as near (near_ball()).
inline RoundedBall rough_ball(RoundedBall ball, double extent)
{
    ball.radius = above(1.001 * ball.radius + 2e-5 * (extent + size_of(ball.center)));
    return ball;
}

inline void add_across(ClearTests& tests, const RoundedBall& ball, const double (&light)[3],
                       double extent, BallOf of)
{
    const double outer = clear_radius(ball, extent);
    AcrossSphere& sphere = tests.across.next();
    double along = 0;
    double length2 = 0;
    double across[2] = {};
    for (int axis = 0; axis < 3; ++axis) {
        along += ball.center[axis] * light[axis];
        length2 += light[axis] * light[axis];
        for (int i = 0; i < 2; ++i)
            across[i] += ball.center[axis] * double{tests.axis[i][axis]};
    }
    sphere.center[0] = static_cast<float>(across[0]);
    sphere.center[1] = static_cast<float>(across[1]);
    sphere.outer2 = static_cast<float>(outer * outer * (1.0 + clear_slack));
    const double past = along + outer * __builtin_sqrt(length2) * (1.0 + clear_slack);
    sphere.along = of == BallOf::rough
                       ? __builtin_inff()
                       : static_cast<float>(past + clear_slack * __builtin_fabs(past));
    const double before = along - outer * __builtin_sqrt(length2) * (1.0 + clear_slack);
    sphere.before = static_cast<float>(before - clear_slack * __builtin_fabs(before));
    const double inner = 2.0 * double{ball.radius} * (1.0 - clear_slack) - outer;
    sphere.inner2 = of == BallOf::sphere && inner > 0
                        ? static_cast<float>(inner * inner * (1.0 - clear_slack))
                        : -1.0f;
    sphere.body = ball.body;
}

inline void add_cone(ClearTests& tests, const RoundedBall& ball, const float (&light)[3],
                     double extent, BallOf of)
{
    ConeSphere& sphere = tests.cones.next();
    double distance2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double to = double{ball.center[axis]} - double{light[axis]};
        sphere.to[axis] = static_cast<float>(to);
        sphere.center[axis] = ball.center[axis];
        distance2 += to * to;
    }
    const double radius = clear_radius(ball, extent);
    const double outer = radius + clear_turn * (radius + __builtin_sqrt(distance2));
    // The squared cosine is 1 - outer²/distance². Its root times the distance is stored.
    const double edge2 = distance2 * (1.0 - clear_slack) - outer * outer;
    sphere.edge = edge2 > 0 ? static_cast<float>(__builtin_sqrt(edge2) * (1.0 - clear_slack))
                            : -__builtin_inff();
    sphere.outer2 = of == BallOf::rough ? __builtin_inff()
                                        : static_cast<float>(outer * outer * (1.0 + clear_slack));
    const double inner = 2.0 * double{ball.radius} * (1.0 - clear_slack) - outer;
    const double inner_edge2 = distance2 * (1.0 + clear_slack) - inner * inner;
    sphere.inner_edge = of == BallOf::sphere && inner > 0 && edge2 > 0
                            ? above(__builtin_sqrt(inner_edge2) * (1.0 + clear_slack))
                            : __builtin_inff();
    sphere.body = ball.body;
}

/// Calls `add(ball, of)` for the balls of a light's possible occluders. An object without a ball
/// makes the tests incomplete.
template <abi::Features F, class Add>
inline void add_balls(ClearTests& tests, const abi::SceneView<float>& casters, double extent,
                      const Add& add)
{
    for (int i = 0; i < casters.spheres.count; ++i)
        add(ball_of(casters.spheres, i), BallOf::sphere);
    for_each_other(casters, [&](const auto& record) {
        const RoundedBall ball = ball_of(record);
        if (ball.radius < __builtin_inff() && F.exact)
            add(ball, BallOf::other);
        else if (ball.radius < __builtin_inff())
            add(rough_ball(ball, extent), BallOf::rough);
        else
            tests.complete = false;
    });
}

/// Two unit vectors perpendicular to `v` and to each other.
inline void set_axes(float (&axis)[2][3], const double (&v)[3])
{
    const int least = __builtin_fabs(v[0]) < __builtin_fabs(v[1])
                          ? (__builtin_fabs(v[0]) < __builtin_fabs(v[2]) ? 0 : 2)
                          : (__builtin_fabs(v[1]) < __builtin_fabs(v[2]) ? 1 : 2);
    double length2 = 0;
    for (const double x : v)
        length2 += x * x;
    double first[3];
    double first2 = 0;
    for (int i = 0; i < 3; ++i) {
        first[i] = (i == least ? 1.0 : 0.0) - v[least] * v[i] / length2;
        first2 += first[i] * first[i];
    }
    const double scale = 1.0 / __builtin_sqrt(first2);
    const double scale2 = scale / __builtin_sqrt(length2);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        axis[0][i] = static_cast<float>(first[i] * scale);
        axis[1][i] = static_cast<float>((v[j] * first[k] - v[k] * first[j]) * scale2);
    }
}

template <abi::Features F>
inline void make_clear_tests(ClearTests& tests, const abi::SceneView<float>& scene,
                             const abi::LightRecord<float>& light, const Origins& origins)
{
    const abi::SceneView<float>& casters = casters_of(scene);
    double extent = extent_of(origins);
    double length2 = 0;
    for (const float x : light.vector)
        length2 += double{x} * x;
    if (light.kind == abi::LightKind::point)
        extent += __builtin_sqrt(length2);
    const Vec3v<float> vector = broadcast(light.vector);
    const vreal<float> squared = dot(vector, vector);
    tests.length2 = first_lane<float>(squared);
    tests.inverse_length = first_lane<float>(vreal<float>(1.0f) / sqrt(squared));
    tests.least_distance2 = static_cast<float>(clear_distance * extent * clear_distance * extent);
    tests.complete = is_moderate(extent) && casters.certifiable &&
                     (light.kind == abi::LightKind::point || is_moderate(length2));
    add_anchored(tests, casters, light, origins, extent);
    add_planes(tests, casters, light, extent);
    if (light.kind == abi::LightKind::point)
        return add_balls<F>(tests, casters, extent, [&](const RoundedBall& ball, BallOf of) {
            add_cone(tests, ball, light.vector, extent, of);
        });
    const double direction[3] = {light.vector[0], light.vector[1], light.vector[2]};
    set_axes(tests.axis, direction);
    add_balls<F>(tests, casters, extent, [&](const RoundedBall& ball, BallOf of) {
        add_across(tests, ball, direction, extent, of);
    });
}

/// A ball that contains all points of a surface; its radius is infinite if there is none.
struct SurfaceBall {
    double center[3] = {};
    double radius = __builtin_inf();
};

inline SurfaceBall surface_ball(const double (&center)[3], double radius)
{
    return {{center[0], center[1], center[2]}, radius * 1.00001};
}

inline SurfaceBall surface_ball(const abi::SceneView<float>& scene, std::int32_t surface)
{
    const abi::SurfaceIndex& index = scene.shapes.index[surface];
    switch (index.kind) {
        case abi::SurfaceKind::sphere: {
            const abi::SphereShape& shape = scene.shapes.spheres[index.record];
            return surface_ball(shape.center, shape.radius);
        }
        case abi::SurfaceKind::quadric_side:
        case abi::SurfaceKind::low_cap:
        case abi::SurfaceKind::high_cap: {
            const abi::QuadricRecord<double>& shape = scene.shapes.quadrics[index.record];
            return surface_ball(shape.bound, shape.bound_radius);
        }
        case abi::SurfaceKind::polygon: {
            const abi::PolygonRecord<double>& shape = scene.shapes.polygons[index.record];
            return surface_ball(shape.bound, shape.bound_radius);
        }
        default:
            return {};
    }
}

/// Whether all points of a ball are in front of a plane.
inline bool is_in_front(const FrontPlane& plane, const SurfaceBall& ball)
{
    double level = 0;
    double size = ball.radius;
    for (int axis = 0; axis < 3; ++axis) {
        level += double{plane.normal[axis]} * ball.center[axis];
        size += __builtin_fabs(ball.center[axis]);
    }
    return level - ball.radius > double{plane.offset} + clear_slack * size;
}

/// Whether no segment from a ball towards a directional light comes close to a sphere.
inline bool is_past(const ClearTests& tests, const AcrossSphere& sphere, const SurfaceBall& ball,
                    const float (&light)[3])
{
    double across2 = 0;
    double along = 0;
    double length2 = 0;
    for (int of = 0; of < 2; ++of) {
        double x = -double{sphere.center[of]};
        for (int axis = 0; axis < 3; ++axis)
            x += double{tests.axis[of][axis]} * ball.center[axis];
        across2 += x * x;
    }
    for (int axis = 0; axis < 3; ++axis) {
        along += double{light[axis]} * ball.center[axis];
        length2 += double{light[axis]} * light[axis];
    }
    const double distance = __builtin_sqrt(across2);
    return distance * (1.0 - 1e-5) > ball.radius + __builtin_sqrt(double{sphere.outer2}) ||
           along - ball.radius * __builtin_sqrt(length2) * 1.00001 >
               double{sphere.along} + 1e-5 * __builtin_fabs(along);
}

/// Whether no segment from a ball to a point light comes close to a sphere.
inline bool is_past(const ConeSphere& sphere, const SurfaceBall& ball, const float (&light)[3])
{
    // The point of the segment between the light and the ball's centre that is closest to the
    // sphere's centre. The other points of the ball are at most its radius closer.
    double along = 0;
    double length2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = ball.center[axis] - double{light[axis]};
        along += way * double{sphere.to[axis]};
        length2 += way * way;
    }
    double share = length2 > 0 ? along / length2 : 0;
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    double distance2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = share * (ball.center[axis] - double{light[axis]});
        const double from = double{sphere.to[axis]} - way;
        distance2 += from * from;
    }
    return __builtin_sqrt(distance2) * (1.0 - 1e-5) >
           ball.radius + __builtin_sqrt(double{sphere.outer2});
}

/// Finds the tests that points of a surface need: not those of the object itself, nor those that no
/// point of the surface can fail.
inline void find_needed(ClearTests& tests, const abi::SceneView<float>& scene,
                        const abi::LightRecord<float>& light, std::int32_t surface)
{
    NeededTests& needed = tests.needed[surface];
    const SurfaceBall ball = surface < 0 ? SurfaceBall{} : surface_ball(scene, surface);
    for (const FrontPlane& plane : tests.planes)
        if (plane.behind != surface && !is_in_front(plane, ball))
            needed.planes.next() = &plane;
    for (const AcrossSphere& sphere : tests.across)
        if (!is_on(sphere.body, surface) && !is_past(tests, sphere, ball, light.vector))
            needed.across.next() = &sphere;
    for (const ConeSphere& sphere : tests.cones)
        if (!is_on(sphere.body, surface) && !is_past(sphere, ball, light.vector))
            needed.cones.next() = &sphere;
}

template <abi::Features F>
inline void find_all_needed(ClearTests& tests, const abi::SceneView<float>& scene,
                            const abi::LightRecord<float>& light)
{
    find_needed(tests, scene, light, -1);
    FramePlan<F>::for_each_surface(
        scene, [&](std::int32_t surface) { find_needed(tests, scene, light, surface); });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
