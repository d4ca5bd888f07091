// Polygons: reading and writing them, and that the scalar reference hits them where they are.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <packtrace/compare.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>
#include <packtrace/validate.hpp>
#include <packtrace/write_scene.hpp>

#include "catch.hpp"
#include "lab/stress/stress_subject.hpp"
#include "lab/truth/textbook.hpp"
#include "lab/truth/wide_truth.hpp"
#include "lower/packed_lists.hpp"
#include "lower/prune.hpp"
#include "packet_ways.hpp"
#include "reference/surfaces/hits.hpp"
#include "reference/surfaces/inside.hpp"
#include "reference/surfaces/own_roots.hpp"
#include "reference_scenes.hpp"
#include "render_scene.hpp"
#include "scene_text.hpp"

namespace packtrace::test {
namespace {

using Contours = std::vector<std::vector<Vec3>>;

Object polygon(const Contours& contours)
{
    return {.surface = Polygon{contours}};
}

/// The six faces of |x|, |y|, |z| <= 1, each with its normal outwards.
std::vector<Object> cube_faces()
{
    std::vector<Object> faces;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            std::vector<Vec3> corners;
            for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                Vec3 corner;
                corner[axis] = side;
                corner[(axis + 1) % 3] = side > 0 ? u : v;
                corner[(axis + 2) % 3] = side > 0 ? v : u;
                corners.push_back(corner);
            }
            faces.push_back(polygon({corners}));
        }
    return faces;
}

/// Five points of radius 2 around the z axis with notches of 0.8, and a hole of 0.4.
Object star()
{
    std::vector<Vec3> outline, hole;
    for (int i = 0; i < 10; ++i) {
        const double angle = 0.628318530717958647 * i;
        const Vec3 way(std::sin(angle), std::cos(angle), 0.0);
        outline.push_back((i % 2 == 0 ? 2.0 : 0.8) * way);
        if (i % 2 == 0)
            hole.push_back(0.4 * way);
    }
    return polygon({outline, hole});
}

Scene scene_of(std::vector<Object> objects)
{
    return {.objects = std::move(objects)};
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed)
    {
    }
    double between(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    std::size_t below(std::size_t end)
    {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(engine_);
    }
    Vec3 box(double half)
    {
        return {between(-half, half), between(-half, half), between(-half, half)};
    }

private:
    std::mt19937_64 engine_;
};

Mat4 some_transform(Random& random)
{
    Mat4 m = glm::translate(Mat4(1.0), random.box(5.0));
    m = glm::rotate(m, random.between(0.0, 6.0), glm::normalize(random.box(1.0) + Vec3(0, 0, 2)));
    m[0] += 0.4 * m[1];
    return glm::scale(m, Vec3(random.between(0.3, 3.0), -random.between(0.3, 3.0), 1.7));
}

template <class Real>
std::vector<reference::SurfaceHit<Real>> hits_of(const reference::Bodies<Real>& bodies,
                                                 const Vec3& org, const Vec3& dir, Real least = 0)
{
    return reference::all_hits<Real>(bodies, reference::Vec3<Real>(org), reference::Vec3<Real>(dir),
                                     least, std::numeric_limits<Real>::infinity());
}

/// A corner of the cube, a point of an edge, or one of a face.
Vec3 target(Random& random, int ray)
{
    Vec3 point = random.box(1.0);
    for (int axis = 0; axis <= ray % 3; ++axis)
        point[(axis + ray / 3) % 3] = random.between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    return point;
}

/// Rays from inside a cube at its faces, edges and corners that do not leave it just once there.
template <class Real>
int leaks_of_cube(int rays, unsigned seed, const Mat4& m)
{
    Random random(seed);
    std::vector<Object> faces = cube_faces();
    for (Object& face : faces)
        face.transform = m;
    const reference::Bodies<Real> bodies(scene_of(faces));
    int leaks = 0;
    for (int ray = 0; ray < rays; ++ray) {
        const Vec3 org(m * glm::dvec4(random.box(0.9), 1));
        const Vec3 dir = Vec3(m * glm::dvec4(target(random, ray), 1)) - org;
        const auto hits = hits_of(bodies, org, dir);
        leaks += hits.size() == 1 && hits[0].leaving && std::abs(hits[0].t - 1) < 1e-3 ? 0 : 1;
    }
    return leaks;
}

double distance_to(const Vec3& org, const Vec3& dir, double t, double radius)
{
    return std::abs(glm::length(org + t * dir) - radius);
}

const std::string triangle = "polygon { vertices = (0, 0, 3), (1, 0, 3), (0, 1, 3)";

bool is_valid(const Scene& scene)
{
    try {
        validate(scene);
        return true;
    } catch (const SceneError&) {
        return false;
    }
}

/// Of a point in its plane.
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

TEST_CASE("polygons are read contour by contour", "[polygons]")
{
    const Scene scene = parse(triangle + " vertices = (.1, .1, 3), (.2, .1, 3), (.1, .2, 3) }");
    const auto& surface = std::get<Polygon>(scene.objects[0].surface);
    CHECK(surface.contours ==
          Contours{{{0, 0, 3}, {1, 0, 3}, {0, 1, 3}}, {{.1, .1, 3}, {.2, .1, 3}, {.1, .2, 3}}});
    CHECK(polygon_normal(surface) == Vec3(0, 0, 1));
    CHECK(polygon_normal(Polygon{}) == Vec3(0.0));
    CHECK(scene.objects[0].name == "polygon 1");
}

TEST_CASE("a polygon is written as it is read", "[polygons]")
{
    Scene scene = scene_of({star(), cube_faces()[3]});
    Random random(1);
    scene.objects[0].transform = some_transform(random);
    const Scene back = parse(scene_text(scene));
    REQUIRE(back.objects.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(std::get<Polygon>(back.objects[i].surface).contours ==
              std::get<Polygon>(scene.objects[i].surface).contours);
        CHECK(back.objects[i].transform == scene.objects[i].transform);
    }
}

TEST_CASE("a polygon of ten thousand corners is read", "[polygons]")
{
    std::string text = "polygon {\nvertices =";
    for (int i = 0; i < 10'000; ++i) {
        const double angle = 6.283185307179586 * i / 10'000;
        text += (i > 0 ? ",\n(" : " (") + std::to_string(std::cos(angle)) + ", " +
                std::to_string(std::sin(angle)) + ", 3)";
    }
    CHECK(std::get<Polygon>(parse(text + " }").objects[0].surface).contours[0].size() == 10'000);
}

TEST_CASE("polygons that are none are refused with what is wrong", "[polygons]")
{
    CHECK(
        error_of("polygon { }") ==
        "x.scene:1:1: polygon has no 'vertices'; add for example vertices = (0, 0, 3), (1, 0, 3), "
        "(0, 1, 3)");
    CHECK(
        error_of("polygon { vertices = (0, 0, 3), (1, 0, 3) }") ==
        "x.scene:1:11: polygon 1: the polygon has a contour of 2 vertices; give it three or more");
    CHECK(error_of("polygon { vertices = (0, 0, 3), (1, 0, 3), (5, 0, 3) }") ==
          "x.scene:1:11: polygon 1: the polygon's first contour encloses no area: its vertices are "
          "on one "
          "line, or it crosses itself into halves that cancel; move one, or begin with another "
          "contour");
    CHECK(error_of("polygon { vertices = (0, 0, 3), (2, 0, 3), (2, 2, 3), (0, 2, 3.01) }") ==
          "x.scene:1:11: polygon 1: the polygon is not flat: vertex 2 is 0.005 off its plane, and "
          "2.83e-06 is "
          "allowed; move it, or split the polygon into flat ones");
    CHECK(error_of("polygon { vertices = (0, 0), (1, 0), (0, 1) }") ==
          "x.scene:1:22: 'vertices' wants 3 numbers, not 2; write vertices = (0, 0, 3), (1, 0, 3), "
          "(0, 1, 3)");
    CHECK(error_of("polygon { vertices = 7 }") ==
          "x.scene:1:22: 'vertices' wants points in brackets; write vertices = (0, 0, 3), (1, 0, "
          "3), (0, 1, 3)");
    CHECK(error_of(triangle + " checker = (0, 0, 0), (255, 255, 255), 1 }") ==
          "x.scene:1:54: polygon 1: only a plane can have a checker; remove it and use color");

    Object unreal = cube_faces()[0];
    std::get<Polygon>(unreal.surface).contours[0][1].y = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(validate(scene_of({unreal})),
                      ContainsSubstring("polygon 1: 'vertices' wants a finite number, not 'nan'"));
    CHECK_THROWS_WITH(validate(scene_of({polygon({})})),
                      ContainsSubstring("the polygon has no vertices"));
}

TEST_CASE("what is left of a corner by seven digits is flat", "[polygons]")
{
    Random random(5);
    for (int i = 0; i < 100; ++i) {
        Object object = star();
        const Mat4 m = some_transform(random);
        for (auto& contour : std::get<Polygon>(object.surface).contours)
            for (Vec3& corner : contour)
                for (int axis = 0; axis < 3; ++axis)
                    corner[axis] =
                        static_cast<double>(static_cast<float>((m * glm::dvec4(corner, 1))[axis]));
        CHECK_FALSE(polygon_fault(std::get<Polygon>(object.surface)));
    }
}

TEMPLATE_TEST_CASE("every ray from inside a cube of polygons leaves it once", "[polygons]", float,
                   double)
{
    CHECK(leaks_of_cube<TestType>(100'000, 11, Mat4(1.0)) == 0);
    Random random(13);
    CHECK(leaks_of_cube<TestType>(100'000, 12, some_transform(random)) == 0);
}

TEST_CASE("a million rays aimed at edges and corners leave a cube of polygons once",
          "[polygons][slow]")
{
    Random random(14);
    for (unsigned seed = 0; seed < 10; ++seed) {
        CHECK(leaks_of_cube<double>(50'000, seed, some_transform(random)) == 0);
        CHECK(leaks_of_cube<float>(50'000, seed, some_transform(random)) == 0);
    }
}

TEMPLATE_TEST_CASE("lines from outside hit a cube of polygons twice or not at all", "[polygons]",
                   float, double)
{
    Random random(12);
    const reference::Bodies<TestType> bodies(scene_of(cube_faces()));
    int odd = 0;
    int met = 0;
    for (int ray = 0; ray < 100'000; ++ray) {
        const Vec3 org = random.box(1.0) + Vec3(0, 0, ray % 2 == 0 ? 3 : -4);
        const std::size_t hits = hits_of(bodies, org, target(random, ray) - org).size();
        odd += hits == 0 || hits == 2 ? 0 : 1;
        met += hits == 2 ? 1 : 0;
    }
    CHECK(odd == 0);
    CHECK(met > 30'000);
}

TEST_CASE("a ray through an edge or a corner of whole numbers hits one polygon", "[polygons]")
{
    const reference::Bodies<double> bodies(scene_of(cube_faces()));
    for (const double x : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0})
            for (const double z : {-1.0, 0.0, 1.0})
                if (const Vec3 dir(x, y, z); dir != Vec3(0.0)) {
                    CAPTURE(x, y, z);
                    CHECK(hits_of(bodies, Vec3(0.0), dir).size() == 1);
                }
}

TEST_CASE("a star with a hole is hit between its outline and its hole", "[polygons]")
{
    const reference::Bodies<double> bodies(scene_of({star()}));
    const auto hits = [&](double x, double y) {
        return hits_of(bodies, {x, y, -5}, {0, 0, 1}).size();
    };
    CHECK(hits(0.0, 0.0) == 0);  // in the hole
    CHECK(hits(0.0, 0.6) == 1);
    CHECK(hits(0.0, 1.9) == 1);   // in a point
    CHECK(hits(0.0, -1.9) == 0);  // below a notch
    CHECK(hits(1.0, 1.0) == 0);   // in a notch's gap
    CHECK(hits(3.0, 0.0) == 0);
}

TEST_CASE("a contour that overlaps itself is inside where it goes round once", "[polygons]")
{
    std::vector<Vec3> pentagram;
    for (int i = 0; i < 5; ++i)
        pentagram.emplace_back(std::sin(2.5132741228718345 * i), std::cos(2.5132741228718345 * i),
                               0.0);
    const reference::Bodies<double> bodies(scene_of({polygon({pentagram})}));
    CHECK(hits_of(bodies, {0, 0, -1}, {0, 0, 1}).empty());
    CHECK(hits_of(bodies, {0, 0.9, -1}, {0, 0, 1}).size() == 1);
}

TEST_CASE("a polygon's normal is its plane's under any affine map", "[polygons]")
{
    Random random(21);
    for (int i = 0; i < 100; ++i) {
        Object flat = polygon({{{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}}});
        Object plane = test::plane({0, 0, 1}, {0, 0, 1});
        flat.transform = plane.transform = some_transform(random);
        const reference::Bodies<double> polygons(scene_of({flat}));
        const reference::Bodies<double> planes(scene_of({plane}));
        const Vec3 org = random.box(8.0);
        const Vec3 at(flat.transform * glm::dvec4(random.box(1.9).x, random.box(1.9).y, 1, 1));
        const auto hits = hits_of(polygons, org, at - org);
        const auto expected = hits_of(planes, org, at - org);
        REQUIRE(hits.size() == 1);
        REQUIRE(expected.size() == 1);
        CHECK(std::abs(hits[0].t - expected[0].t) < 1e-10);
        CHECK(hits[0].leaving == expected[0].leaving);
        CHECK(reference::length(hits[0].normal - expected[0].normal) < 1e-12);
        CHECK(
            hits_of(polygons, org, Vec3(flat.transform * glm::dvec4(2.1, 0, 1, 1)) - org).empty());
    }
}

TEST_CASE("a ray that starts on a polygon never meets it again", "[polygons]")
{
    const reference::Bodies<double> bodies(scene_of({star()}));
    for (const auto side : {reference::Side::outer, reference::Side::inner})
        CHECK(reference::own_roots(bodies.polygons[0], reference::Vec3<double>(0, 0.6, 0),
                                   reference::Vec3<double>(0, 0, 1), reference::Part::side, side)
                  .count == 0);
    CHECK_FALSE(reference::is_inside(bodies.polygons[0], reference::Vec3<double>(0, 0.6, -1)));
}

TEST_CASE("a sphere of polygons is closed, and the nearer the finer it is", "[polygons]")
{
    double last = 1.0;
    for (const int rings : {8, 16, 32}) {
        // Rings of trapezoids between triangles at the poles; neighbours share their corners.
        const auto point = [&](int ring, int step) {
            const double polar = 3.141592653589793 * ring / rings;
            const double turn = 3.141592653589793 * (step % (2 * rings)) / rings;
            return ring == 0       ? Vec3(0, 1, 0)
                   : ring == rings ? Vec3(0, -1, 0)
                                   : Vec3(std::sin(polar) * std::cos(turn), std::cos(polar),
                                          std::sin(polar) * std::sin(turn));
        };
        std::vector<Object> faces;
        for (int ring = 0; ring < rings; ++ring)
            for (int step = 0; step < 2 * rings; ++step) {
                std::vector<Vec3> corners{point(ring, step), point(ring + 1, step),
                                          point(ring + 1, step + 1), point(ring, step + 1)};
                if (ring == 0)
                    corners.pop_back();
                if (ring + 1 == rings)
                    corners.erase(corners.begin() + 1);
                faces.push_back(polygon({corners}));
            }
        const Scene scene = scene_of(faces);
        validate(scene);
        const reference::Bodies<double> bodies(scene);
        Random random(31);
        double worst = 0.0;
        int leaks = 0;
        for (int ray = 0; ray < 2000; ++ray) {
            const Vec3 org = random.box(0.3);
            const Vec3 dir = ray % 2 == 0 ? random.box(1.0) : point(ray % rings, ray / 7) - org;
            const auto hits = hits_of(bodies, org, dir);
            leaks += hits.size() == 1 ? 0 : 1;
            if (!hits.empty())
                worst = std::max(worst, distance_to(org, dir, hits[0].t, 1.0));
        }
        CHECK(leaks == 0);
        CHECK(worst < 0.3 * last);
        last = worst;
    }
}

TEST_CASE("the reference hits polygons where 113 bits say", "[polygons]")
{
    Random random(41);
    int sure = 0;
    for (int i = 0; i < 20; ++i) {
        Object object = star();
        if (i % 2 == 1)
            object.transform = some_transform(random);
        const lab::WideSurface surface(object, 0);
        const reference::Bodies<double> bodies(scene_of({object}));
        const lab::TextbookScene<double> textbook(scene_of({object}));
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
            const auto hits = hits_of(bodies, org, dir);
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

TEST_CASE("bounds of a hit with a polygon hold the true t", "[polygons]")
{
    Random random(51);
    const RenderOptions scalar{.kernel = Kernel::scalar};
    int proven = 0;
    for (int i = 0; i < 20; ++i) {
        Object object = star();
        if (i % 2 == 1)
            object.transform = some_transform(random);
        const lab::WideSurface surface(object, 0);
        const RayScene<double> rays(scene_of({object}), scalar);
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

TEST_CASE("slivers are hit where they are", "[polygons]")
{
    Random random(61);
    const RenderOptions scalar{.kernel = Kernel::scalar};
    for (const double thickness : {1e-3, 1e-5, 1e-7, 1e-9})
        for (int i = 0; i < 40; ++i) {
            const Vec3 along = glm::normalize(random.box(1.0));
            const Vec3 across = glm::normalize(glm::cross(along, random.box(1.0)));
            const Vec3 from = random.box(1.0);
            const Scene scene = scene_of(
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

TEST_CASE("a ray along a polygon's plane meets it within its outline or not at all", "[polygons]")
{
    Random random(67);
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back({.kernel = Kernel::scalar});
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        // Whole numbers in z = 3x - y, which single precision holds exactly.
        const auto in_plane = [&](double size) {
            const Vec3 any = random.box(size);
            const double x = std::round(any.x);
            const double y = std::round(any.y);
            return Vec3(x, y, 3 * x - y);
        };
        const Scene scene = scene_of({polygon({{in_plane(9), in_plane(9), in_plane(9)}})});
        if (!is_valid(scene))
            continue;
        const auto& corners = std::get<Polygon>(scene.objects[0].surface).contours[0];
        for (const RenderOptions& options : ways) {
            const RayScene<double> rays(scene, options);
            const RayScene<float> narrow(scene, options);
            for (int ray = 0; ray < 60; ++ray) {
                // The plane is crossed a few directions on, or not at all.
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

TEST_CASE("a ray that starts in a polygon's plane does not meet it further on", "[polygons]")
{
    std::vector<RenderOptions> ways = packet_ways();
    ways.push_back({.kernel = Kernel::scalar});
    for (int axis = 0; axis < 3; ++axis) {
        // A square in a plane across the axis, seen from within and from all sides.
        const auto at = [&](double height, double u, double v) {
            Vec3 point;
            point[axis] = height;
            point[(axis + 1) % 3] = u;
            point[(axis + 2) % 3] = v;
            return point;
        };
        const Scene scene =
            scene_of({polygon({{at(4, -3, 1), at(4, -1, 1), at(4, -1, 2), at(4, -3, 2)}})});
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

TEST_CASE("polygons are packed by their corners in the world", "[polygons]")
{
    Random random(61);
    Object object = star();
    object.transform = some_transform(random);
    const LoweredScene lowered = lower(scene_of({cube_faces()[0], object}));
    const PackedLists<float> lists(lowered, false);
    abi::GeometryView<float> view;
    lists.show(view);
    REQUIRE(view.polygons.count == 2);
    const abi::PolygonRecord<float>& record = view.polygons.data[1];
    CHECK(record.corner_count == 17);
    CHECK(record.surface == 1);
    std::size_t at = 0;
    for (const auto& contour : std::get<Polygon>(object.surface).contours) {
        for (std::size_t i = 0; i <= contour.size(); ++i, ++at) {
            const auto& corner = record.corners[at];
            const Vec3 world(object.transform * glm::dvec4(contour[i % contour.size()], 1));
            CHECK(corner.position[1] == static_cast<float>(world.y));
            CHECK(corner.starts_contour == (i == 0 ? 1 : 0));
            CHECK(glm::length(world - Vec3(record.bound[0], record.bound[1], record.bound[2])) <=
                  1.000001 * static_cast<double>(record.bound_radius));
        }
    }
}

TEST_CASE("a polygon in another's very place is found", "[polygons]")
{
    Object other = star();
    std::get<Polygon>(other.surface).contours.pop_back();
    LoweredScene lowered = lower(scene_of({star(), other, star()}));
    CHECK(remove_duplicates(lowered) == 1);
    REQUIRE(lowered.polygons.size() == 2);
    CHECK(lowered.polygons[1].surface == 1);
}

/// Scenes of polygons, some with a hierarchy.
std::vector<Scene> polygon_scenes()
{
    Scene picture =
        read_scene(std::filesystem::path(PACKTRACE_SOURCE_DIR) / "scenes/polygons.scene");
    picture.width = 64;
    picture.height = 48;
    return {picture};
}

TEST_CASE("packets of doubles draw polygons as the reference does", "[polygons]")
{
    for (Scene scene : polygon_scenes())
        for (const Traversal traversal : {Traversal::list, Traversal::tree})
            for (const std::string& isa : supported_isas()) {
                const RenderOptions scalar{.kernel = Kernel::scalar};
                const RenderOptions packets{.isa = isa, .traversal = traversal};
                CAPTURE(isa);
                const auto truth = render<double>(scene, scalar);
                CHECK(compare(render<double>(scene, packets), truth).max_abs <= 1e-9);
                CHECK(compare(render<float>(scene, packets), render<float>(scene, scalar)).rmse <=
                      1e-3);
            }
}

/// A sphere of flat facets, each an object; `steps` from pole to pole.
Scene facets(int steps)
{
    Scene scene;
    const auto at = [&](int i, int j) {
        if (i % steps == 0)
            return Vec3(0, i == 0 ? 1 : -1, 0);
        const double down = 3.14159265358979 * i / steps;
        const double turn = 3.14159265358979 * (j % (2 * steps)) / steps;
        return Vec3(std::sin(down) * std::cos(turn), std::cos(down),
                    std::sin(down) * std::sin(turn));
    };
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const Vec3 a = at(i, j);
            const Vec3 b = at(i + 1, j);
            const Vec3 c = at(i + 1, j + 1);
            const Vec3 d = at(i, j + 1);
            if (i + 1 < steps)
                scene.objects.push_back(polygon({{a, b, c}}));
            if (i > 0)
                scene.objects.push_back(polygon({{a, c, d}}));
        }
    return scene;
}

/// Rays from within aimed at corners, edges and elsewhere, each of which has to leave once.
template <class Real>
void check_no_leaks(const Scene& scene, const RenderOptions& options, int count, Random& random)
{
    std::vector<lab::StressRay> aimed;
    for (int i = 0; i < count; ++i) {
        const auto& corners =
            std::get<Polygon>(scene.objects[random.below(scene.objects.size())].surface)
                .contours[0];
        const double share = i % 3 == 0 ? 0.0 : random.between(0, 1);
        const Vec3 org = random.box(0.3);
        const Vec3 at = glm::mix(corners[0], corners[i % 2 == 0 ? 1 : corners.size() - 1], share);
        aimed.push_back({org, at - org, 0.0, std::numeric_limits<double>::infinity()});
    }
    const RayColumns<Real> columns = lab::columns_of<Real>(aimed);
    const RayScene<Real> rays(scene, options);
    int leaks = 0;
    rays.all_hits(columns.view(), [&](std::size_t, std::span<const SurfaceHit<Real>> hits) {
        leaks += hits.size() % 2 == 0;
    });
    CHECK(leaks == 0);
    std::vector<std::int32_t> object(aimed.size());
    std::vector<Real> t(aimed.size());
    rays.closest_hits(columns.view(), {t.data(), object.data()});
    CHECK(std::count(object.begin(), object.end(), -1) == 0);
}

TEST_CASE("no ray slips between polygons that share an edge", "[polygons]")
{
    Random random(71);
    for (const Scene& scene : {facets(6), facets(30)})
        for (const std::string& isa : supported_isas())
            for (const Accuracy accuracy : {Accuracy::exact, Accuracy::fast})
                for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
                    const RenderOptions options{
                        .isa = isa, .accuracy = accuracy, .traversal = traversal};
                    CAPTURE(isa, scene.objects.size());
                    check_no_leaks<float>(scene, options, 2000, random);
                    check_no_leaks<double>(scene, options, 2000, random);
                }
}

// PACKTRACE_POLYGON_RAYS asks for more than the suite has time for, such as ten million.
TEST_CASE("many rays at edges of a hundred thousand polygons do not slip through",
          "[polygons][slow]")
{
    const char* const wanted = std::getenv("PACKTRACE_POLYGON_RAYS");
    const int count = wanted != nullptr ? std::atoi(wanted) : 50'000;
    Random random(72);
    const Scene scene = facets(160);
    for (int done = 0; done < count; done += 100'000) {
        check_no_leaks<float>(scene, {}, std::min(count - done, 100'000), random);
        check_no_leaks<double>(scene, {}, std::min(count - done, 100'000), random);
    }
}

}  // namespace packtrace::test
