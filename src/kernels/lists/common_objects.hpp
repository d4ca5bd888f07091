#pragma once

#include "kernels/geometry/anchored_sphere.hpp"
#include "kernels/geometry/rounded_ball.hpp"
#include "kernels/lists/borrowed_list.hpp"
#include "kernels/precision/lone_sphere.hpp"

// Spheres, anchored spheres and planes for packets that mostly hit one object (common_hit.hpp):
// with error bounds for a set of ray origins, and with the values that refining needs. Quadrics and
// polygons have a bounding ball.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A ball that contains an object, with error bounds (sphere_filter.hpp).
struct CommonBall {
    float center[3];
    float from_center[3];  ///< from the centre to the shared origin
    float outer2;
    float slack2;  ///< squared error of the slope w·d, per |d|
    Body body;
};

/// A sphere, with its exact record for refining.
struct CommonSphere : CommonBall {
    float inner2;
    float clear2;  ///< squared radius; points among the origins that are further away are outside
    float radius2;
    float inverse_radius;
    double exact_center[3];
    double exact_radius2;
};

/// A ground: an anchored sphere, or a plane as one with curvature 0. It has the exact equation, the
/// rounded one, and the errors of its terms.
struct CommonGround {
    float base[3], normal[3], curvature, offset;
    float shared_gradient[3], shared_value;  ///< of the equation at the shared origin
    float value_error;                       ///< error of F(0)
    float slope_error2;                      ///< squared error of b, per |d|
    float discriminant_error;                ///< error of the discriminant, per d·d
    float side;  ///< -1 for a plane whose normal points away from the shared origin, else 1
    float top[3], top_offset;  ///< a plane that the ground is behind; points behind that plane are
                               ///< not decided
    bool origin_above;         ///< the shared origin is in front of that plane
    double exact_base[3], exact_normal[3], exact_curvature, exact_offset;
    std::int32_t surface;
};

/// Objects of a scene, in the order of the scene's lists.
struct CommonLists {
    BorrowedList<CommonSphere> spheres;
    BorrowedList<CommonGround> grounds;  ///< anchored spheres, then planes
    BorrowedList<CommonBall> balls;      ///< around quadrics, then polygons

    /// Takes memory for all objects of a scene.
    template <class Arena>
    void take(Arena& arena, const abi::GeometryView<float>& scene)
    {
        spheres.take(arena, static_cast<std::size_t>(scene.spheres.count));
        grounds.take(arena,
                     static_cast<std::size_t>(scene.anchored_spheres.count + scene.planes.count));
        balls.take(arena, static_cast<std::size_t>(scene.quadrics.count + scene.polygons.count));
    }
    void clear()
    {
        spheres.clear();
        grounds.clear();
        balls.clear();
    }
    [[nodiscard]] bool empty() const
    {
        return spheres.empty() && grounds.empty() && balls.empty();
    }
};

/// The objects of a scene, with error bounds for a set of ray origins.
struct CommonObjects : CommonLists {
    float center[3] = {};  ///< centre of the origins
    float near2 = 0;       ///< squared radius of the origins, slightly reduced
    bool are_all = false;  ///< bounds hold, and these are all objects that the rays may hit
};

/// A relative margin for rounding errors in tests of points, and for the offsets of points at which
/// rays start or end: 64 roundoffs, at least four times what is lost.
inline constexpr double clear_slack = 64.0 * 0x1p-24;
inline double distance_of(const double (&a)[3], const double (&b)[3])
{
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
        sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return __builtin_sqrt(sum);
}

/// An upper bound of the distance of the ray origins and lights from the world's origin.
inline double extent_of(const Origins& origins)
{
    double center2 = 0;
    for (const float x : origins.center)
        center2 += double{x} * x;
    return __builtin_sqrt(center2) + double{origins.radius};
}

/// Whether squares of such magnitudes neither overflow nor underflow in single precision.
inline bool is_moderate(double extent)
{
    return extent < 1e8 && extent > 1e-8;
}

/// The distance from a ball's centre at which a shadow ray certainly misses the ball.
inline double clear_radius(const RoundedBall& ball, double extent)
{
    return double{ball.radius} + double{ball.error} +
           clear_slack * (extent + double{ball.radius} + size_of(ball.center));
}

/// The equation of a ground at some points.
inline AnchoredOrigin<float> form_at(const CommonGround& ground, const Vec3v<float>& place)
{
    return anchored_origin<float>(ground.base, ground.normal, ground.curvature, ground.offset,
                                  place);
}

/// Sets the errors of a ground's equation for ray origins up to `distance` from its base. Rounding
/// of the base is included.
inline void set_ground_errors(CommonGround& ground, double distance)
{
    double moved = 0;
    for (int axis = 0; axis < 3; ++axis)
        moved += __builtin_fabs(double{ground.base[axis]} - ground.exact_base[axis]);
    AnchoredFilter errors{};
    errors.curvature = ground.curvature;
    errors.offset = ground.offset;
    set_anchored_errors(errors, distance, Origin::any);
    const double size = 1.0 + ground.exact_curvature * distance;
    const double slope = double{errors.slope_error} + 2.0 * ground.exact_curvature * moved;
    ground.value_error = above(double{errors.value_error} + 3.0 * size * moved);
    ground.slope_error2 = above(slope * slope * (1.0 + clear_slack));
    ground.discriminant_error =
        above(double{errors.discriminant_error} + 8.0 * size * ground.exact_curvature * moved);
}

/// Sets the plane that a ground is behind: through `point` with the unit `normal`.
inline void set_top(CommonGround& ground, const double (&point)[3], const double (&normal)[3],
                    const Origins& origins, const float (&shared_origin)[3])
{
    double size = extent_of(origins);
    double level = 0;
    double origin_level = 0;
    for (int axis = 0; axis < 3; ++axis) {
        ground.top[axis] = static_cast<float>(normal[axis]);
        level += normal[axis] * point[axis];
        origin_level += normal[axis] * double{shared_origin[axis]};
        size += __builtin_fabs(point[axis]);
    }
    const double slack = clear_slack * size;
    ground.top_offset = above(level + slack + 0x1p-22 * __builtin_fabs(level));
    ground.origin_above = origin_level > level + slack;
}

/// Rounds an equation, and sets its errors for `origins`, of which `shared_origin` is one.
inline void set_form(CommonGround& ground, const double (&base)[3], const double (&normal)[3],
                     double curvature, double offset, const Origins& origins,
                     const float (&shared_origin)[3])
{
    double distance = double{origins.radius};
    for (int axis = 0; axis < 3; ++axis) {
        ground.exact_base[axis] = base[axis];
        ground.exact_normal[axis] = normal[axis];
        ground.base[axis] = static_cast<float>(base[axis]);
        ground.normal[axis] = static_cast<float>(normal[axis]);
        distance += __builtin_fabs(double{origins.center[axis]} - base[axis]);
    }
    ground.exact_curvature = curvature;
    ground.exact_offset = offset;
    ground.curvature = static_cast<float>(curvature);
    ground.offset = static_cast<float>(offset);
    set_ground_errors(ground, distance * 1.00001);
    const AnchoredOrigin<float> form = form_at(ground, broadcast(shared_origin));
    ground.shared_gradient[0] = first_lane<float>(form.g.x);
    ground.shared_gradient[1] = first_lane<float>(form.g.y);
    ground.shared_gradient[2] = first_lane<float>(form.g.z);
    ground.shared_value = first_lane<float>(form.constant);
}

/// Fills a ground from an anchored sphere. Its top plane touches it at the point closest to the
/// centre of the origins.
inline void fill_ground(CommonGround& ground, const abi::AnchoredSphere<double>& shape,
                        const Origins& origins, const float (&shared_origin)[3])
{
    set_form(ground, shape.anchor, shape.normal, shape.curvature, shape.offset, origins,
             shared_origin);
    ground.side = 1.0f;
    const double to[3] = {origins.center[0], origins.center[1], origins.center[2]};
    const double distance = distance_of(to, shape.center);
    double point[3];
    double normal[3];
    for (int axis = 0; axis < 3; ++axis) {
        normal[axis] =
            distance > 0 ? (to[axis] - shape.center[axis]) / distance : shape.normal[axis];
        point[axis] = shape.center[axis] + shape.radius * normal[axis];
    }
    set_top(ground, point, normal, origins, shared_origin);
}

/// Fills a ground from a plane, as seen from the side of the shared origin.
inline void fill_ground(CommonGround& ground, const abi::PlaneRecord<double>& shape,
                        const Origins& origins, const float (&shared_origin)[3])
{
    set_form(ground, shape.point, shape.normal, 0.0, 0.0, origins, shared_origin);
    double height = 0;
    for (int axis = 0; axis < 3; ++axis)
        height += shape.normal[axis] * (double{shared_origin[axis]} - shape.point[axis]);
    ground.side = height < 0 ? -1.0f : 1.0f;
    const double side = double{ground.side};
    const double normal[3] = {side * shape.normal[0], side * shape.normal[1],
                              side * shape.normal[2]};
    set_top(ground, shape.point, normal, origins, shared_origin);
}

/// Fills the values of any ball; returns its error bounds.
inline SphereBounds<float> fill_ball(CommonBall& common, const RoundedBall& ball,
                                     const Origins& origins, const float (&shared_origin)[3])
{
    // The distance between a ball among the origins and their centre counts fully.
    double distance = double{origins.radius};
    for (int axis = 0; axis < 3; ++axis) {
        common.center[axis] = ball.center[axis];
        common.from_center[axis] = shared_origin[axis] - ball.center[axis];
        distance += __builtin_fabs(double{ball.center[axis]} - double{origins.center[axis]});
    }
    const float length = above(distance * double{inflation} + double{ball.error});
    const SphereBounds<float> bounds =
        sphere_bounds(ball.radius, ball.error, madd(roundoffs(2.4f), length, ball.error));
    common.outer2 = bounds.outer2;
    const double slack = double{bounds.along} + roundoffs(28.0f) * distance;
    common.slack2 = above(slack * slack * (1.0 + clear_slack));
    common.body = ball.body;
    return bounds;
}

inline void fill_sphere(CommonSphere& sphere, const abi::SceneView<float>& scene, int i,
                        const Origins& origins, const float (&shared_origin)[3])
{
    const RoundedBall ball = ball_of(scene.spheres, i);
    const SphereBounds<float> bounds = fill_ball(sphere, ball, origins, shared_origin);
    sphere.inner2 = bounds.inner2;
    const double clear = clear_radius(ball, extent_of(origins));
    sphere.clear2 = above(clear * clear * (1.0 + clear_slack));
    const abi::SphereShape& shape = sphere_of(scene.shapes, ball.body.first);
    for (int axis = 0; axis < 3; ++axis)
        sphere.exact_center[axis] = shape.center[axis];
    sphere.exact_radius2 = shape.radius * shape.radius;
    const float radius = static_cast<float>(shape.radius);
    sphere.radius2 = radius * radius;
    sphere.inverse_radius = 1.0f / radius;
}

/// Ray origins count as near up to this multiple of the radius of all bounded objects and the
/// camera. Error bounds hold for all near origins, so a larger multiple would make more rays
/// unsure. On note 001's ground 1.5 % of the hits are beyond 64 times, and one eighth beyond 8
/// times; each packet with such hits gets error bounds of its own.
inline constexpr double near_scale = 64.0;

/// The ball of ray origins that error bounds are computed for: around the bounded objects and the
/// box of known origins.
inline Origins near_origins(const abi::SceneView<float>& scene, const float (&low_origin)[3],
                            const float (&high_origin)[3])
{
    float low[3];
    float high[3];
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = low_origin[axis];
        high[axis] = high_origin[axis];
    }
    const auto enclose = [&](const RoundedBall& ball) {
        for (int axis = 0; axis < 3 && ball.radius < __builtin_inff(); ++axis) {
            low[axis] = min(low[axis], ball.center[axis] - ball.radius);
            high[axis] = max(high[axis], ball.center[axis] + ball.radius);
        }
    };
    for (int i = 0; i < scene.spheres.count; ++i)
        enclose(ball_of(scene.spheres, i));
    for_each_other(scene, [&](const auto& record) { enclose(ball_of(record)); });
    Origins origins = origins_in(low, high);
    // If there is no bounded object and only one origin, that origin's surroundings count too.
    origins.radius = max(origins.radius, 1.0f) * static_cast<float>(near_scale);
    return origins;
}

/// With more objects, testing them one by one takes longer than it saves.
inline constexpr int most_common_objects = 32;
/// Smaller spheres lose digits to underflow.
inline constexpr float least_common_radius = 1e-15f;

/// The number of objects in a scene's lists.
inline int listed_objects(const abi::GeometryView<float>& scene)
{
    return scene.spheres.count + scene.anchored_spheres.count + scene.planes.count +
           scene.quadrics.count + scene.polygons.count;
}

/// Whether a scene has so few objects, all in lists.
inline bool has_few_objects(const abi::GeometryView<float>& scene)
{
    return scene.tree.empty() && listed_objects(scene) <= most_common_objects;
}

/// Fills `common` with the objects of a scene whose first surface is `wanted(surface)`, for rays
/// from `origins` that hit no other object. `shared_origin` is one of the origins, the shared one
/// if rays share it; planes are prepared for rays from its side.
template <class Wanted>
inline void fill_common(CommonObjects& common, const abi::SceneView<float>& scene,
                        const Origins& origins, const float (&shared_origin)[3],
                        const Wanted& wanted)
{
    for (int axis = 0; axis < 3; ++axis)
        common.center[axis] = origins.center[axis];
    common.near2 = origins.radius * origins.radius * 0.999f;
    common.are_all = scene.wide != nullptr && has_few_objects(scene) && scene.certifiable &&
                     certifiable(origins) && is_moderate(extent_of(origins));
    if (!common.are_all)
        return;
    common.clear();
    for (int i = 0; i < scene.spheres.count; ++i) {
        if (!wanted(scene.spheres.surface[i]))
            continue;
        fill_sphere(common.spheres.next(), scene, i, origins, shared_origin);
        common.are_all &= scene.spheres.radius[i] > least_common_radius;
    }
    for_each_other(scene, [&](const auto& record) {
        const RoundedBall ball = ball_of(record);
        if (!wanted(ball.body.first))
            return;
        fill_ball(common.balls.next(), ball, origins, shared_origin);
        common.are_all &= ball.radius < __builtin_inff();
    });
    const auto fill = [&](const auto& list, const auto* shapes) {
        for (int i = 0; i < list.count; ++i) {
            const std::int32_t surface = list.data[i].surface;
            if (!wanted(surface))
                continue;
            CommonGround& ground = common.grounds.next();
            ground.surface = surface;
            fill_ground(ground, shapes[scene.shapes.index[surface].record], origins, shared_origin);
        }
    };
    fill(scene.anchored_spheres, scene.shapes.anchored_spheres);
    fill(scene.planes, scene.shapes.planes);
}

/// The same with all objects.
inline void fill_common(CommonObjects& common, const abi::SceneView<float>& scene,
                        const Origins& origins, const float (&shared_origin)[3])
{
    fill_common(common, scene, origins, shared_origin, [](std::int32_t) { return true; });
}

/// The lanes whose points are outside the ball of origins.
inline std::uint32_t far_lanes(const CommonObjects& common, const Vec3v<float>& place)
{
    const Vec3v<float> from = place - broadcast(common.center);
    return ~bits(dot(from, from) <= vreal<float>(common.near2)) & all_lanes<float>;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
