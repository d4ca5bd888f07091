// The points that lights reach: RayScene::lit().
#include "catch.hpp"
#include "lower/packed_scene.hpp"
#include "packet_ways.hpp"
#include "scenes.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <glm/gtc/matrix_transform.hpp>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

using Mask = std::vector<std::uint8_t>;

/// Rays with their hits and hit points.
template <class Real>
struct Seen {
    std::array<std::vector<Real>, 8> rays;
    std::vector<Real> t;
    std::array<std::vector<Real>, 3> normal, outer, inner, point;
    std::vector<std::int32_t> object, surface;

    [[nodiscard]] std::size_t count() const
    {
        return rays[0].size();
    }
    [[nodiscard]] PointsView<Real> points() const
    {
        return {{point[0].data(), point[1].data(), point[2].data()}, surface.data(), count()};
    }
};

/// Rays from around one point into a cube around another.
template <class Real>
Seen<Real> look(const RayScene<Real>& scene, std::size_t count, const Vec3& from, double spread,
                const Vec3& to, double size)
{
    SceneRandom random(5);
    Seen<Real> seen;
    for (std::size_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const double org = from[axis] + random.between(-spread, spread);
            const double target = to[axis] + random.between(-size, size);
            seen.rays[static_cast<std::size_t>(axis)].push_back(static_cast<Real>(org));
            seen.rays[static_cast<std::size_t>(axis) + 3].push_back(
                static_cast<Real>(target - org));
        }
    seen.rays[6].assign(count, Real(0));
    seen.rays[7].assign(count, std::numeric_limits<Real>::infinity());
    HitsView<Real> hits;
    seen.t.resize(count);
    seen.object.resize(count);
    seen.surface.resize(count);
    hits.t = seen.t.data();
    hits.object = seen.object.data();
    hits.surface = seen.surface.data();
    const auto room = [&](std::vector<Real>& column) {
        column.resize(count);
        return column.data();
    };
    hits.normal_x = room(seen.normal[0]);
    hits.normal_y = room(seen.normal[1]);
    hits.normal_z = room(seen.normal[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        hits.outer_start[axis] = room(seen.outer[axis]);
        hits.inner_start[axis] = room(seen.inner[axis]);
        hits.point[axis] = room(seen.point[axis]);
    }
    const auto& r = seen.rays;
    scene.closest_hits({r[0].data(), r[1].data(), r[2].data(), r[3].data(), r[4].data(),
                        r[5].data(), r[6].data(), r[7].data(), count},
                       hits);
    return seen;
}

template <class Real>
Mask lit(const RayScene<Real>& scene, const PointsView<Real>& points, std::size_t light = 0)
{
    Mask mask(points.count, 7);
    scene.lit(points, light, mask.data());
    return mask;
}

using Vec = std::array<long double, 3>;

long double dot(const Vec& a, const Vec& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether a sphere is between a point and a light, in long double; no value if the rounding of the
/// point may decide.
std::optional<bool> is_between(const Sphere& ball, const Vec& point, const Vec& way, bool endless,
                               bool own)
{
    const Vec center{ball.center.x, ball.center.y, ball.center.z};
    const Vec w{point[0] - center[0], point[1] - center[1], point[2] - center[2]};
    const long double a = dot(way, way);
    const long double b = dot(w, way);
    const long double r = ball.radius;
    const long double size =
        r + std::sqrt(dot(w, w)) + std::sqrt(dot(point, point)) + std::sqrt(dot(center, center));
    const long double tolerance = 4e-6L * size;
    if (own)
        return std::abs(b) < tolerance * std::sqrt(a) ? std::optional<bool>() : b < 0;
    const long double nearest = -b / a;
    const long double end = endless ? std::numeric_limits<long double>::infinity() : 1.0L;
    const long double at = std::min(std::max(nearest, 0.0L), end);
    const Vec closest{w[0] + at * way[0], w[1] + at * way[1], w[2] + at * way[2]};
    const Vec start = w;
    const long double distance = std::sqrt(dot(closest, closest));
    if (std::abs(distance - r) < tolerance ||
        std::abs(std::sqrt(dot(start, start)) - r) < tolerance)
        return {};
    if (distance > r)
        return false;
    // The segment enters the ball: it hits the sphere unless both ends are inside.
    if (endless)
        return true;
    const Vec last{w[0] + way[0], w[1] + way[1], w[2] + way[2]};
    const long double from_last = std::sqrt(dot(last, last));
    if (std::abs(from_last - r) < tolerance)
        return {};
    return from_last > r || dot(start, start) > r * r;
}

/// Whether a light reaches a point past all spheres of a scene.
template <class Real>
std::optional<bool> is_lit(const Scene& scene, const Light& light, const Seen<Real>& seen,
                           std::size_t i)
{
    const Vec point{seen.point[0][i], seen.point[1][i], seen.point[2][i]};
    const bool endless = light.type == LightType::directional;
    Vec way{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        const long double vector = static_cast<Real>(light.vector[axis]);
        way[at] = endless ? vector : vector - point[at];
    }
    bool unknown = false;
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
        if (!scene.objects[k].casts_shadow)
            continue;
        const auto between = is_between(std::get<Sphere>(scene.objects[k].surface), point, way,
                                        endless, static_cast<std::int32_t>(k) == seen.object[i]);
        if (between && *between)
            return false;
        unknown |= !between;
    }
    return unknown ? std::optional<bool>() : true;
}

/// Compares answers for a scene of spheres with long double. Most points must be decidable.
template <class Real>
void check_spheres(const Scene& scene, const RenderOptions& options, const Seen<Real>& seen,
                   const RayScene<Real>& rays)
{
    INFO(options.isa);
    for (std::size_t light = 0; light < scene.lights.size(); ++light) {
        if (scene.lights[light].type == LightType::ambient)
            continue;
        const Mask mask = lit(rays, seen.points(), light);
        int wrong = 0;
        int decided = 0;
        int reached = 0;
        for (std::size_t i = 0; i < seen.count(); ++i) {
            if (seen.object[i] < 0)
                continue;
            const auto expected = is_lit(scene, scene.lights[light], seen, i);
            decided += expected ? 1 : 0;
            reached += mask[i];
            wrong += expected && *expected != (mask[i] == 1) ? 1 : 0;
        }
        CAPTURE(light);
        CHECK(wrong == 0);
        CHECK(decided > static_cast<int>(seen.count()) / 4);
        CHECK(reached > decided / 20);
    }
}

/// Overlapping spheres over a large one.
Scene crowd(int count)
{
    SceneRandom random(31);
    Scene scene;
    const Material material = scratch(Rgb(0.5), 50, 0);
    for (int i = 0; i < count; ++i) {
        const double x = random.between(-3, 3);
        const double y = random.between(-3, 3);
        const double z = random.between(3, 9);
        add_sphere(scene, {x, y, z}, random.between(0.05, 0.6), material);
    }
    add_sphere(scene, {0, -5004, 0}, 5000, material);
    scene.lights = {{LightType::point, Rgb(0.6), {6, 9, -4}},
                    {LightType::ambient, Rgb(0.2), Vec3(0.0)},
                    {LightType::directional, Rgb(0.2), {1, 4, -2}},
                    {LightType::point, Rgb(0.6), {0.2, 0.1, 5.5}}};
    return scene;
}

/// One point of the world that is not on a known surface.
Mask one_point(const RayScene<double>& scene, const Vec3& at, std::size_t light)
{
    const double x[] = {at.x};
    const double y[] = {at.y};
    const double z[] = {at.z};
    return lit(scene, {{x, y, z}, nullptr, 1}, light);
}

/// Checks that the only light reaches no point of the upper cap of the only body. The cap is about
/// at `cap`, as wide as high, and seen from beyond.
template <class Real>
void check_dark_cap(const RayScene<Real>& rays, std::size_t count, double height, const Vec3& cap)
{
    const auto seen = look(rays, count, {0, 0, 2 * height}, 0.1 * height, cap, height);
    const Mask mask = lit(rays, seen.points());
    int hits = 0;
    int reached = 0;
    for (std::size_t i = 0; i < seen.count(); ++i)
        if (seen.object[i] == 0 && seen.surface[i] == 2) {
            ++hits;
            reached += mask[i];
        }
    CHECK(hits > 100);
    CHECK(reached == 0);
}

}  // namespace

TEST_CASE("a ball's shadow is where calculation by hand puts it", "[lit]")
{
    const Scene scene = parse_scene(R"(
        sphere { center = (0, 2, 0)  radius = 1 }
        plane { point = (0, 0, 0)  normal = (0, 1, 0) }
        light { type = point  position = (0, 4, 0)  intensity = 1 }
        light { type = directional  direction = (0, 1, 0)  intensity = 1 }
    )",
                                    "ball", {});
    const RenderOptions scalar{.kernel = Kernel::scalar};
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back(scalar);
    for (const RenderOptions& options : ways) {
        const RayScene<double> rays(scene, options);
        // The cone from the light touches the ball at 30 degrees: its shadow ends at 4 tan 30.
        const double edge = 4.0 / std::sqrt(3.0);
        CHECK(one_point(rays, {edge - 1e-6, 0.0, 0}, 0) == Mask{0});
        CHECK(one_point(rays, {edge + 1e-6, 0.0, 0}, 0) == Mask{1});
        CHECK(one_point(rays, {0, 2.5, 0}, 0) == Mask{0});
        CHECK(one_point(rays, {0, 3.5, 0}, 0) == Mask{1});
        CHECK(one_point(rays, {0, -1, 5}, 0) == Mask{0});
        CHECK(one_point(rays, {0.999999, 0.5, 0}, 1) == Mask{0});
        CHECK(one_point(rays, {1.000001, 0.5, 0}, 1) == Mask{1});
        CHECK(one_point(rays, {0, 7, 0}, 1) == Mask{1});
        CHECK(one_point(rays, {std::nan(""), 7, 0}, 1) == Mask{0});
        CHECK(one_point(rays, {5, std::nan(""), 0}, 0) == Mask{0});
    }
}

TEST_CASE("lights reach the same points among spheres as in exact arithmetic", "[lit]")
{
    const Scene scene = crowd(150);
    for (RenderOptions options : packet_ways()) {
        {
            const RayScene<double> rays(scene, options);
            check_spheres(scene, options, look(rays, 3000, {0, 1, -6}, 2, {0, -1, 6}, 4), rays);
        }
        const RayScene<float> rays(scene, options);
        const auto seen = look(rays, 3000, {0, 1, -6}, 2, {0, -1, 6}, 4);
        check_spheres(scene, options, seen, rays);
        options.accuracy = Accuracy::fast;
        check_spheres(scene, options, seen, RayScene<float>(scene, options));
    }
}

TEST_CASE("lights at any distance reach the same points as in exact arithmetic", "[lit]")
{
    for (const double distance : {1e3, 1e5, 1e7, 5e8}) {
        CAPTURE(distance);
        for (const int count : {4, 300}) {
            Scene scene = crowd(count);
            scene.lights.clear();
            for (const Vec3& to : {Vec3(0.5, 0.8, -0.3), Vec3(-0.9, 0.3, -0.2)})
                scene.lights.push_back({LightType::point, Rgb(0.6), distance * to});
            for (const RenderOptions& options : packet_ways()) {
                const RayScene<float> rays(scene, options);
                check_spheres(scene, options, look(rays, 3000, {0, 1, -6}, 2, {0, -1, 6}, 4), rays);
            }
        }
    }
}

TEST_CASE("in a moved scene lights reach the same points as in a new scene, far lights too",
          "[lit]")
{
    Scene scene = parse_scene(R"(
        sphere { center = (0, 0, 3)  radius = 0.3 }
        sphere { center = (2, 0, 3)  radius = 0.0001  casts_shadow = no }
        polygon { vertices = (-2, 1, -2), (-2, 1, 5), (3, 1, 5), (3, 1, -2) }
        light { type = point  position = (0.37, 0.9999999, 0.071)  intensity = 1 }
        light { type = point  position = (3e3, -5e3, 1e3)  intensity = 1 }
    )",
                              "moved", {});
    const RenderOptions options{.traversal = Traversal::tree};
    RayScene<float> moved(scene, options);
    const auto seen = look(moved, 3000, {0, 0, 0}, 0.5, {0, 0.5, 3}, 1.5);
    for (int i = 0; i < 3; ++i) {
        (void)moved.update(scene, std::vector<std::int32_t>{0});
        const RayScene<float> fresh(scene, options);
        for (const std::size_t light : {std::size_t{0}, std::size_t{1}})
            CHECK(lit(moved, seen.points(), light) == lit(fresh, seen.points(), light));
    }
}

TEST_CASE("light buffers change no answer, however many calls ask", "[lit]")
{
    const Scene scene = crowd(300);
    RenderOptions options{.traversal = Traversal::list};
    const RayScene<float> by_lists(scene, options);
    const auto seen = look(by_lists, 20000, {0, 1, -6}, 2, {0, -1, 6}, 4);
    options.traversal = Traversal::tree;
    const PackedScene<float> packed(lower(scene), Traversal::tree);
    REQUIRE(packed.rays_for_light_buffer() > 1000);
    REQUIRE(packed.rays_for_light_buffer() < 20000);
    for (const IsaInfo& isa : list_isas()) {
        if (!isa.supported)
            continue;
        INFO(isa.name);
        options.isa = isa.name;
        const RayScene<float> by_tree(scene, options);
        for (const std::size_t light : std::array<std::size_t, 3>{0, 2, 3}) {
            const Mask expected = lit(by_lists, seen.points(), light);
            PointsView<float> few = seen.points();
            few.count = 500;
            CHECK(lit(by_tree, few, light) == Mask(expected.begin(), expected.begin() + 500));
            CHECK(lit(by_tree, seen.points(), light) == expected);
            CHECK(lit(by_tree, seen.points(), light) == expected);
        }
    }
}

TEST_CASE("points on every kind of surface are lit as rays that leave them see it", "[lit]")
{
    const Scene scene = parse_scene(R"(
        plane { point = (0, -2, 0)  normal = (0.1, 1, 0) }
        sphere { center = (0, 0, 6)  radius = 1.2 }
        ellipsoid { scale = (1, 0.4, 0.7)  translate = (2, 0.5, 5) }
        cylinder { z_range = (-1, 1)  capped = true  rotate = (1, 1, 0, 50)  translate = (-2, 0, 5) }
        hyperboloid { z_range = (-1, 1)  scale = (0.5, 0.5, 0.8)  translate = (0, 1.5, 4) }
        polygon { vertices = (-3, -1, 7), (3, -1, 7), (3, 3, 8), (-3, 3, 8) }
        light { type = point  position = (3, 5, 0)  intensity = 1 }
        light { type = directional  direction = (-1, 2, -1.5)  intensity = 1 }
    )",
                                    "kinds", {});
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        const RayScene<double> rays(scene, options);
        const auto seen = look(rays, 4000, {0, 1, -3}, 1, {0, 0, 6}, 4);
        for (std::size_t light = 0; light < 2; ++light) {
            const Light& from = scene.lights[light];
            const bool endless = from.type == LightType::directional;
            const Mask mask = lit(rays, seen.points(), light);
            int differ = 0;
            int hits = 0;
            for (std::size_t i = 0; i < seen.count(); ++i) {
                if (seen.object[i] < 0)
                    continue;
                ++hits;
                const Vec3 point(seen.point[0][i], seen.point[1][i], seen.point[2][i]);
                const Vec3 way = endless ? from.vector : from.vector - point;
                const bool outside = way.x * seen.normal[0][i] + way.y * seen.normal[1][i] +
                                         way.z * seen.normal[2][i] >=
                                     0;
                const auto& start = outside ? seen.outer : seen.inner;
                Ray<double> ray{{start[0][i], start[1][i], start[2][i]}, {way.x, way.y, way.z}};
                if (!endless)
                    ray.t_max = 1.0 - 1e-12;
                differ += rays.occluded(ray) == (mask[i] == 0) ? 0 : 1;
            }
            CAPTURE(light);
            CHECK(hits > 2000);
            CHECK(differ == 0);
        }
    }
}

TEST_CASE("a lamp in the wall of a dome lights all of it, and one behind the wall nothing", "[lit]")
{
    for (const std::string dome : {"sphere { center = (0, -1, 3)  radius = 3 }",
                                   "ellipsoid { scale = (3, 3, 4)  translate = (0, -1, 3) }",
                                   "cylinder { z_range = (-4, 2)  capped = yes  scale = (4, 4, 1)"
                                   "  rotate = (1, 0, 0, -90)  translate = (0, 0, 3) }"}) {
        const Scene scene = parse_scene(dome + R"(
            light { type = point  position = (0, 2, 3)  intensity = 1 }
            light { type = point  position = (0, 1.9999, 3)  intensity = 1 }
            light { type = point  position = (0, 2.0001, 3)  intensity = 1 }
        )",
                                        "dome", {});
        const auto check = [&](const auto& rays) {
            const auto seen = look(rays, 2000, {0, 0.5, 2}, 0.5, {0, -1, 3}, 2);
            int reached[3] = {};
            int hits = 0;
            for (std::size_t light = 0; light < 3; ++light) {
                const Mask mask = lit(rays, seen.points(), light);
                for (std::size_t i = 0; i < seen.count(); ++i) {
                    // A cap this high has the light behind it, on its outer side, which the light
                    // reaches.
                    const bool counts = seen.object[i] >= 0 && seen.point[1][i] < 1.9;
                    hits += light == 0 && counts ? 1 : 0;
                    reached[light] += counts ? mask[i] : 0;
                }
            }
            CHECK(hits > 1000);
            CHECK(reached[0] == hits);
            CHECK(reached[1] == hits);
            CHECK(reached[2] == 0);
        };
        for (const RenderOptions& options : packet_ways()) {
            CAPTURE(dome, options.isa, options.traversal);
            check(RayScene<double>(scene, options));
            check(RayScene<float>(scene, options));
        }
    }
}

TEMPLATE_TEST_CASE("a lamp beyond the cut of a long cone lights nothing of its far end", "[lit]",
                   float, double)
{
    // At the lamp the cone's equation has the sign of an inner point, but that half of the cone is
    // cut off. Seen from the far end, the lamp is next to the near end.
    const double heights[] = {1e3, 1e5, 1e7, sizeof(TestType) == sizeof(float) ? 1e8 : 1e13};
    for (const double height : heights) {
        const std::string z_range = "z_range = (-0.25, " + std::to_string(height) + ")";
        const Scene scene = parse_scene("cone { " + z_range + R"(  capped = yes
                   matrix = (2.5, 0, 0, -0.75, 0, 2, 0, 1.9, 0, 0, 0.9, 2.2) }
            light { type = point  position = (-0.7, 3.7, -1.6)  intensity = 1 }
        )",
                                        "cone", {});
        for (const RenderOptions& options : packet_ways()) {
            CAPTURE(height, options.isa, options.traversal);
            const RayScene<TestType> rays(scene, options);
            check_dark_cap(rays, 500, height, {0, 0, 0.9 * height});
        }
    }
}

TEMPLATE_TEST_CASE("the half of a body around a lamp hides the lamp from the other half's far end",
                   "[lit]", float, double)
{
    // The segment leaves one half and enters the other; both hits are close to the lamp.
    const double heights[] = {1e3, 1e4, 1e6, sizeof(TestType) == sizeof(float) ? 1e7 : 1e10};
    for (const double height : heights)
        for (const std::string body :
             {"cone { z_range = (-1, ", "hyperboloid2 { z_range = (-2, "}) {
            const bool is_cone = body.starts_with("cone");
            const Scene scene =
                parse_scene(body + std::to_string(height) + ")  capped = yes }" +
                                "light { type = point  intensity = 1  position = (0.25, 0.125, " +
                                (is_cone ? "-0.5) }" : "-1.5) }"),
                            "halves", {});
            for (const RenderOptions& options : packet_ways()) {
                CAPTURE(body, height, options.isa, options.traversal);
                const RayScene<TestType> rays(scene, options);
                check_dark_cap(rays, 300, height, {0, 0, height});
            }
        }
}

TEMPLATE_TEST_CASE("a lamp next to a cone's apex lights all of its half of the cone, and no other",
                   "[lit]", float, double)
{
    // In single precision the points themselves are this far off the cone.
    const std::vector<double> ways = sizeof(TestType) == sizeof(float)
                                         ? std::vector<double>{0x1p-4}
                                         : std::vector<double>{0x1p-16, 0x1p-20, 0x1p-24};
    for (const double off : ways) {
        Scene scene = parse_scene("cone { z_range = (-0.5, 128)  capped = yes }", "cone", {});
        scene.lights = {
            Light{.type = LightType::point, .intensity = Rgb(1), .vector = {0, 0, off}},
            Light{.type = LightType::point, .intensity = Rgb(1), .vector = {off / 4, 0, -off}}};
        for (const RenderOptions& options : packet_ways()) {
            CAPTURE(off, options.isa, options.traversal);
            const RayScene<TestType> rays(scene, options);
            // From inside, where the whole wall is visible.
            const auto seen = look(rays, 400, {0, 0, 60}, 1, {0, 0, 85}, 120);
            int hits = 0;
            int reached[2] = {};
            for (std::size_t light = 0; light < 2; ++light) {
                const Mask mask = lit(rays, seen.points(), light);
                for (std::size_t i = 0; i < seen.count(); ++i)
                    if (seen.object[i] == 0 && seen.surface[i] == 0 && seen.point[2][i] > 20) {
                        hits += light == 0 ? 1 : 0;
                        reached[light] += mask[i];
                    }
            }
            CHECK(hits > 100);
            CHECK(reached[0] == hits);
            CHECK(reached[1] == 0);
        }
    }
}

namespace {

/// A lamp next to the rim of a body, and a point on the body's side.
struct RimLamp {
    std::string body;
    std::array<double, 3> point, lamp;
    bool lit;
};

template <class Real>
void check_rim_lamp(const RimLamp& at, const RenderOptions& options)
{
    Scene scene = parse_scene(at.body, "rim", {});
    Light lamp;
    lamp.type = LightType::point;
    lamp.vector = Vec3(at.lamp[0], at.lamp[1], at.lamp[2]);
    scene.lights = {lamp};
    std::array<Real, 3> point;
    for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = static_cast<Real>(at.point[axis]);
    const std::int32_t side = 0;
    std::uint8_t mask = 7;
    const RayScene<Real> rays(scene, options);
    rays.lit({{&point[0], &point[1], &point[2]}, &side, 1}, 0, &mask);
    CAPTURE(at.body, options.isa, sizeof(Real));
    CHECK((mask != 0) == at.lit);
}

}  // namespace

TEST_CASE("a lamp next to a body's rim lights what neither the body's side nor its cap occludes",
          "[lit]")
{
    const std::string tube =
        "matrix = (0.8, 0, 0.6, 0,  0, 1, 0, 0,  -0.6, 0, 0.8, 0)  z_range = (0, 1)";
    // The first lamp is inside the wall and just above its open end; the second is outside and just
    // below the cap's plane.
    const std::vector<RimLamp> single{
        {"cylinder { " + tube + " }",
         {-0.0492417067, 0.584281027, 1.28693008},
         {1.03688991, -0.837592542, 0.472332597},
         true},
        {"hyperboloid2 { z_range = (1.30007215582308, 2.198177121509878) matrix = (0, "
         "-2.6047993528663658, 0, 898.0058993301612,  0.5320656966053872, 0, 0, "
         "221.24972653909617,  0, 0, -0.11569050152173481, 1089.7497097332418) }",
         {894.364013671875, 221.97865295410156, 1089.495361328125},
         {896.54449462890625, 220.25190734863281, 1089.495361328125},
         true},
        {"cylinder { capped = true " + tube + " }",
         {1.28114402, 0.524156094, 0.288821638},
         {-0.146186724, -0.360844046, 1.35964},
         false}};
    const RimLamp twofold{
        "cylinder { z_range = (-279, -1.75) capped = true matrix = "
        "(-0.5749881347154874, 0, 0, -1.3804497188025855,  0, "
        "0.036329399794340134, 0, -9.51632093693057,  0, 0, "
        "0.036329399794340134, -8.20297456503858) }",
        {-1.0622895514570876, -9.4860600058932327, -18.338872784416239},
        {-0.81310201679831984, -9.5222236981988964, -18.338877107659478},
        false};
    for (const RenderOptions& options : packet_ways()) {
        for (const RimLamp& at : single)
            check_rim_lamp<float>(at, options);
        check_rim_lamp<double>(twofold, options);
    }
}

TEST_CASE("an object that casts no shadow occludes no light", "[lit]")
{
    Scene scene = crowd(150);
    for (std::size_t i = 0; i < scene.objects.size(); i += 2)
        scene.objects[i].casts_shadow = false;
    const RenderOptions options{.traversal = Traversal::tree};
    const RayScene<float> rays(scene, options);
    const auto seen = look(rays, 3000, {0, 1, -6}, 2, {0, -1, 6}, 4);
    check_spheres(scene, options, seen, rays);

    Mask hits(seen.count());
    for (std::size_t i = 0; i < seen.count(); ++i)
        hits[i] = seen.object[i] >= 0 ? 1 : 0;
    for (Light& light : scene.lights)
        light.casts_shadow = light.type == LightType::ambient;
    CHECK(lit(RayScene<float>(scene, options), seen.points(), 0) == hits);
    for (Light& light : scene.lights)
        light.casts_shadow = true;
    scene.shadows = ShadowKind::none;
    CHECK(lit(RayScene<float>(scene, options), seen.points(), 2) == hits);
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar}) {
        const RayScene<double> without(scene, {.kernel = kernel});
        CHECK(one_point(without, {0, std::nan(""), 0}, 0) == Mask{0});
        CHECK(one_point(without, {0, 2, 0}, 0) == Mask{1});
    }
}

TEST_CASE("lights reach moved objects where they are now", "[lit]")
{
    Scene scene = crowd(150);
    scene.objects[1].casts_shadow = false;
    const RenderOptions options{.traversal = Traversal::tree};
    RayScene<float> rays(scene, options);
    const auto before = look(rays, 2000, {0, 1, -6}, 2, {0, -1, 6}, 4);
    const Mask old = lit(rays, before.points(), 0);
    for (int step = 0; step < 3; ++step) {
        for (std::size_t i = 0; i < 150; ++i)
            scene.objects[i].transform =
                glm::translate(Mat4(1.0), Vec3(0.1 * step, 0.02 * step, -0.05 * step));
        rays.update(scene);
        const auto seen = look(rays, 2000, {0, 1, -6}, 2, {0, -1, 6}, 4);
        const RayScene<float> anew(scene, options);
        CHECK(lit(rays, seen.points(), 0) == lit(anew, seen.points(), 0));
        CHECK(lit(rays, seen.points(), 2) == lit(anew, seen.points(), 2));
        if (step > 0)
            CHECK(lit(rays, seen.points(), 0) != old);
    }
}

TEST_CASE("several threads may query lights at once", "[lit]")
{
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
    Scene scene = crowd(300);
    for (std::size_t i = 0; i < scene.objects.size(); i += 10)
        scene.objects[i].casts_shadow = false;
    RenderOptions options{.traversal = Traversal::list};
    const RayScene<float> by_lists(scene, options);
    const auto seen = look(by_lists, 16384, {0, 1, -6}, 2, {0, -1, 6}, 4);
    const Mask expected = lit(by_lists, seen.points());
    options.traversal = Traversal::tree;
    const RayScene<float> rays(scene, options);
    // The first calls prepare data, and the light buffer is built between them.
    Mask mask(seen.count(), 7);
    tbb::task_arena(3).execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seen.count(), 512),
                          [&](const auto& range) {
                              PointsView<float> points = seen.points();
                              for (auto& component : points.point)
                                  component += range.begin();
                              points.surface += range.begin();
                              points.count = range.size();
                              rays.lit(points, 0, mask.data() + range.begin());
                          });
    });
    CHECK(mask == expected);
}

TEST_CASE("lights that nothing can occlude are refused", "[lit]")
{
    const Scene scene = crowd(3);
    const RenderOptions scalar{.kernel = Kernel::scalar};
    for (const RenderOptions& options : {RenderOptions(), scalar}) {
        const RayScene<double> rays(scene, options);
        CHECK_THROWS_WITH(one_point(rays, {0, 0, 0}, 1),
                          Catch::Matchers::StartsWith("lights[1] is ambient"));
        CHECK_THROWS_WITH(one_point(rays, {0, 0, 0}, 4),
                          Catch::Matchers::StartsWith("lights[4] of 4"));
        CHECK(one_point(rays, {0, 50, 0}, 3).size() == 1);
    }
}

}  // namespace packtrace::test
