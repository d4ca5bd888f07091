// Hits of polygons by the scalar reference and by packets, and their proven bounds.
#include "catch.hpp"
#include "lab/truth/textbook.hpp"
#include "lab/truth/wide_truth.hpp"
#include "packet_ways.hpp"
#include "polygon_scenes.hpp"
#include "reference/surfaces/inside.hpp"
#include "reference/surfaces/own_roots.hpp"
#include "reference_scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/validate.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace packtrace::test {
namespace {

bool is_valid(const Scene& scene)
{
    try {
        validate(scene);
        return true;
    } catch (const SceneError&) {
        return false;
    }
}

/// A star with a random transform; every other one has no transform.
Object placed_star(int number, PolygonRandom& random)
{
    Object object = star();
    if (number % 2 == 1)
        object.transform = some_transform(random);
    return object;
}

/// The distance of a point in the triangle's plane.
double distance_to_triangle(const Vec3& point, const std::vector<Vec3>& corners)
{
    const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 edge = corners[(i + 1) % 3] - corners[i];
        const Vec3 off = point - corners[i];
        inside = inside && glm::dot(glm::cross(edge, off), normal) >= 0;
        const double share = glm::clamp(glm::dot(off, edge) / glm::dot(edge, edge), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(off - share * edge));
    }
    return inside ? 0.0 : nearest;
}

}  // namespace

TEST_CASE("a ray through an edge or a corner of whole numbers hits one polygon", "[polygon_hits]")
{
    const reference::Bodies<double> bodies(polygon_scene(cube_faces()));
    for (const double x : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0})
            for (const double z : {-1.0, 0.0, 1.0})
                if (const Vec3 dir(x, y, z); dir != Vec3(0.0)) {
                    CAPTURE(x, y, z);
                    CHECK(reference_hits(bodies, Vec3(0.0), dir).size() == 1);
                }
}

TEST_CASE("a star is hit between its outline and its hole", "[polygon_hits]")
{
    const reference::Bodies<double> bodies(polygon_scene({star()}));
    const auto hits = [&](double x, double y) {
        return reference_hits(bodies, {x, y, -5}, {0, 0, 1}).size();
    };
    CHECK(hits(0.0, 0.0) == 0);  // in the hole
    CHECK(hits(0.0, 0.6) == 1);
    CHECK(hits(0.0, 1.9) == 1);   // in a point
    CHECK(hits(0.0, -1.9) == 0);  // below a notch
    CHECK(hits(1.0, 1.0) == 0);   // in a notch
    CHECK(hits(3.0, 0.0) == 0);
}

TEST_CASE("the even-odd rule decides what is inside a contour that overlaps itself",
          "[polygon_hits]")
{
    std::vector<Vec3> pentagram;
    for (int i = 0; i < 5; ++i)
        pentagram.emplace_back(std::sin(2.5132741228718345 * i), std::cos(2.5132741228718345 * i),
                               0.0);
    const reference::Bodies<double> bodies(polygon_scene({polygon({pentagram})}));
    CHECK(reference_hits(bodies, {0, 0, -1}, {0, 0, 1}).empty());
    CHECK(reference_hits(bodies, {0, 0.9, -1}, {0, 0, 1}).size() == 1);
}

TEST_CASE("a polygon has the normal of its plane under any affine map", "[polygon_hits]")
{
    PolygonRandom random(21);
    for (int i = 0; i < 100; ++i) {
        Object flat = polygon({{{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}}});
        Object plane = test::plane({0, 0, 1}, {0, 0, 1});
        flat.transform = plane.transform = some_transform(random);
        const reference::Bodies<double> polygons(polygon_scene({flat}));
        const reference::Bodies<double> planes(polygon_scene({plane}));
        const Vec3 org = random.box(8.0);
        const Vec3 at(flat.transform * glm::dvec4(random.box(1.9).x, random.box(1.9).y, 1, 1));
        const auto hits = reference_hits(polygons, org, at - org);
        const auto expected = reference_hits(planes, org, at - org);
        REQUIRE(hits.size() == 1);
        REQUIRE(expected.size() == 1);
        CHECK(std::abs(hits[0].t - expected[0].t) < 1e-10);
        CHECK(hits[0].leaving == expected[0].leaving);
        CHECK(reference::length(hits[0].normal - expected[0].normal) < 1e-12);
        CHECK(reference_hits(polygons, org, Vec3(flat.transform * glm::dvec4(2.1, 0, 1, 1)) - org)
                  .empty());
    }
}

TEST_CASE("a ray that starts on a polygon never hits it again", "[polygon_hits]")
{
    const reference::Bodies<double> bodies(polygon_scene({star()}));
    for (const auto side : {reference::Side::outer, reference::Side::inner})
        CHECK(reference::own_roots(bodies.polygons[0], reference::Vec3<double>(0, 0.6, 0),
                                   reference::Vec3<double>(0, 0, 1), reference::Part::side, side)
                  .count == 0);
    CHECK_FALSE(reference::is_inside(bodies.polygons[0], reference::Vec3<double>(0, 0.6, -1)));
}

TEST_CASE("the reference hits polygons where 113 bits say", "[polygon_hits]")
{
    PolygonRandom random(41);
    int sure = 0;
    for (int i = 0; i < 20; ++i) {
        const Object object = placed_star(i, random);
        const lab::WideSurface surface(object, 0);
        const reference::Bodies<double> bodies(polygon_scene({object}));
        const lab::TextbookScene<double> textbook(polygon_scene({object}));
        for (int ray = 0; ray < 500; ++ray) {
            const Vec3 org = random.box(6.0);
            const auto& outline = std::get<Polygon>(object.surface).contours[0];
            const Vec3 own = ray % 3 == 0
                                 ? outline[static_cast<std::size_t>(ray) % 10]
                                 : Vec3(2.2 * random.box(1.0).x, 2.2 * random.box(1.0).y, 0);
            const Vec3 dir = Vec3(object.transform * glm::dvec4(own, 1)) - org;
            std::vector<lab::TrueHit> found;
            const double no_end = std::numeric_limits<double>::infinity();
            lab::find_true_hits(surface, {org, dir, 0.0, no_end}, found);
            REQUIRE(found.size() == 1);
            if (found[0].margin < 1e-12)
                continue;
            ++sure;
            const auto hits = reference_hits(bodies, org, dir);
            REQUIRE(hits.size() == (found[0].exists ? 1u : 0u));
            CHECK(textbook.closest_hit({org, dir, 0.0, no_end}).object ==
                  (found[0].exists ? 0 : -1));
            if (hits.empty())
                continue;
            const auto t = static_cast<double>(found[0].t);
            CHECK(std::abs(hits[0].t - t) <= 1e-14 * found[0].condition * t);
            const Vec3 normal = lab::narrow(found[0].normal);
            CHECK(glm::length(Vec3(hits[0].normal.x, hits[0].normal.y, hits[0].normal.z) - normal) <
                  1e-12);
        }
    }
    CHECK(sure > 6000);
}

TEST_CASE("bounds of a hit with a polygon contain the true t", "[polygon_hits]")
{
    PolygonRandom random(51);
    const RenderOptions scalar{.kernel = Kernel::scalar};
    int proven = 0;
    for (int i = 0; i < 20; ++i) {
        const Object object = placed_star(i, random);
        const lab::WideSurface surface(object, 0);
        const RayScene<double> rays(polygon_scene({object}), scalar);
        for (int ray = 0; ray < 100; ++ray) {
            const Vec3 org = random.box(6.0);
            const Vec3 own(2.2 * random.box(1.0).x, 2.2 * random.box(1.0).y, 0);
            const Vec3 dir = Vec3(object.transform * glm::dvec4(own, 1)) - org;
            const double t_min = 0.0, t_max = 1e9;
            const RaysView<double> view{&org.x, &org.y, &org.z, &dir.x, &dir.y,
                                        &dir.z, &t_min, &t_max, 1};
            std::vector<lab::TrueHit> found;
            lab::find_true_hits(surface, {org, dir, t_min, t_max}, found);
            const std::int32_t first = 0;
            HitBounds bounds;
            rays.bound_closest_hits(view, &first, &bounds);
            CHECK(bounds.empty() == !found[0].exists);
            if (!found[0].exists)
                continue;
            CHECK((bounds.low <= found[0].t && found[0].t <= bounds.high));
            proven += bounds.high - bounds.low <= 1e-15 * bounds.high ? 1 : 0;
        }
    }
    CHECK(proven > 400);
}

TEST_CASE("slivers are hit exactly where they are", "[polygon_hits]")
{
    PolygonRandom random(61);
    const RenderOptions scalar{.kernel = Kernel::scalar};
    for (const double thickness : {1e-3, 1e-5, 1e-7, 1e-9})
        for (int i = 0; i < 40; ++i) {
            const Vec3 along = glm::normalize(random.box(1.0));
            const Vec3 across = glm::normalize(glm::cross(along, random.box(1.0)));
            const Vec3 from = random.box(1.0);
            const Scene scene = polygon_scene(
                {polygon({{from, from + along, from + 0.5 * along + thickness * across}})});
            const RayScene<double> bounds(scene, scalar);
            const RayScene<double> packets(scene);
            for (int ray = 0; ray < 20; ++ray) {
                const Vec3 target = from + 0.5 * along + thickness * (0.25 + 0.01 * ray) * across;
                const Vec3 org = target + 3.0 * random.box(1.0);
                const Vec3 dir = target - org;
                const double t_min = 0.0, t_max = 1e9;
                const RaysView<double> view{&org.x, &org.y, &org.z, &dir.x, &dir.y,
                                            &dir.z, &t_min, &t_max, 1};
                const std::int32_t first = 0;
                HitBounds proven;
                bounds.bound_closest_hits(view, &first, &proven);
                if (proven.empty())
                    continue;
                const Ray<double> one{{org.x, org.y, org.z}, {dir.x, dir.y, dir.z}};
                const double slope = std::abs(
                    glm::dot(glm::normalize(dir), glm::normalize(glm::cross(along, across))));
                for (const RayScene<double>* rays : {&bounds, &packets}) {
                    const SurfaceHit<double> hit = rays->closest_hit(one);
                    if (hit.object < 0)
                        continue;
                    CAPTURE(thickness, slope);
                    CHECK(std::abs(hit.t - proven.low) < 1e-14 / slope);
                }
            }
        }
}

TEST_CASE("a ray along a polygon's plane hits it within its outline or misses it", "[polygon_hits]")
{
    PolygonRandom random(67);
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back({.kernel = Kernel::scalar});
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        // Whole numbers on z = 3x - y, which single precision represents exactly.
        const auto in_plane = [&](double size) {
            const Vec3 any = random.box(size);
            const double x = std::round(any.x);
            const double y = std::round(any.y);
            return Vec3(x, y, 3 * x - y);
        };
        const Scene scene = polygon_scene({polygon({{in_plane(9), in_plane(9), in_plane(9)}})});
        if (!is_valid(scene))
            continue;
        const auto& corners = std::get<Polygon>(scene.objects[0].surface).contours[0];
        for (const RenderOptions& options : ways) {
            const RayScene<double> rays(scene, options);
            const RayScene<float> narrow(scene, options);
            for (int ray = 0; ray < 60; ++ray) {
                // The ray crosses the plane after a few lengths of its direction, or never.
                const Vec3 off(0, 0, std::round(random.between(-3, 3)));
                const Vec3 turn(0, 0, std::round(random.between(-1, 1)));
                const Vec3 org = in_plane(15);
                const Vec3 dir = in_plane(5);
                const Vec3 o = org + 0x1p-46 * off;
                const Vec3 d = dir + 0x1p-46 * turn;
                for (const SurfaceHit<double>& hit :
                     rays.all_hits(Ray<double>{{o.x, o.y, o.z}, {d.x, d.y, d.z}})) {
                    ++hits;
                    CHECK(turn.z != 0);
                    CHECK(distance_to_triangle(o + hit.t * d, corners) < 1e-9);
                }
                if (options.kernel == Kernel::scalar)
                    continue;
                const glm::vec3 of(org + 0x1p-18 * off);
                const glm::vec3 df(dir + 0x1p-18 * turn);
                const Ray<float> single{{of.x, of.y, of.z}, {df.x, df.y, df.z}};
                const SurfaceHit<float> first = narrow.closest_hit(single);
                if (first.object >= 0)
                    CHECK(distance_to_triangle(Vec3(of) + double{first.t} * Vec3(df), corners) <
                          1e-4);
            }
        }
    }
    CHECK(hits > 10);
}

TEST_CASE("a ray that starts in a polygon's plane does not hit it further on", "[polygon_hits]")
{
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back({.kernel = Kernel::scalar});
    for (int axis = 0; axis < 3; ++axis) {
        // A square in a plane across the axis, with rays from inside the plane and from all sides.
        const auto at = [&](double height, double u, double v) {
            Vec3 point;
            point[axis] = height;
            point[(axis + 1) % 3] = u;
            point[(axis + 2) % 3] = v;
            return point;
        };
        const Scene scene =
            polygon_scene({polygon({{at(4, -3, 1), at(4, -1, 1), at(4, -1, 2), at(4, -3, 2)}})});
        for (const RenderOptions& options : ways) {
            const RayScene<double> rays(scene, options);
            const RayScene<float> narrow(scene, options);
            for (const double slope : {1e-300, -1e-30, 1e-30, -1e-17, 1e-13, 1e-9, -1e-5, 1.0})
                for (const double turn : {0.0, 1e-30, -0.25, 3.0}) {
                    const Vec3 o = at(4, -2, 1.375);
                    const Vec3 d = at(slope, turn, 1.25);
                    CAPTURE(axis, options.isa, slope, turn);
                    CHECK(rays.closest_hit(Ray<double>{{o.x, o.y, o.z}, {d.x, d.y, d.z}}).object <
                          0);
                    if (options.kernel == Kernel::scalar)
                        continue;
                    const glm::vec3 of(o);
                    const glm::vec3 df(d);
                    CHECK(narrow.closest_hit(Ray<float>{{of.x, of.y, of.z}, {df.x, df.y, df.z}})
                              .object < 0);
                }
        }
    }
}

TEST_CASE("rays with NaN hit no polygon, and infinite rays return", "[polygon_hits]")
{
    PolygonRandom random(83);
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back({.kernel = Kernel::scalar});
    for (int i = 0; i < 60; ++i) {
        const Scene scene = polygon_scene(
            {polygon({{10.0 * random.box(1.0), 10.0 * random.box(1.0), 10.0 * random.box(1.0)}})});
        const int axis = i % 3;
        for (const RenderOptions& options : ways) {
            Vec3 dir = random.box(20.0);
            dir[axis] = std::numeric_limits<double>::quiet_NaN();
            CAPTURE(options.isa, axis);
            CHECK(RayScene<double>(scene, options)
                      .closest_hit({{0, 0, 0}, {dir.x, dir.y, dir.z}})
                      .object == -1);
            CHECK(RayScene<float>(scene, options)
                      .closest_hit({{0, 0, 0},
                                    {static_cast<float>(dir.x), static_cast<float>(dir.y),
                                     static_cast<float>(dir.z)}})
                      .object == -1);
            dir[axis] = std::numeric_limits<double>::infinity();
            (void)RayScene<double>(scene, options).closest_hit({{0, 0, 0}, {dir.x, dir.y, dir.z}});
        }
    }
}

}  // namespace packtrace::test
