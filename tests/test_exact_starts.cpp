// Rays with special numbers for which rounding errors are not acceptable: through poles that clips
// touch, from points of a surface, from far along a cylinder, and at coefficients of very different
// sizes.
#include "catch.hpp"
#include "packet_ways.hpp"
#include "scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

using Triple = std::array<double, 3>;

template <class Real>
Ray<Real> ray_of(const Triple& org, const Triple& dir)
{
    const auto real = [](double x) { return static_cast<Real>(x); };
    return {{real(org[0]), real(org[1]), real(org[2])}, {real(dir[0]), real(dir[1]), real(dir[2])}};
}

struct KnownHit {
    std::string text;
    Triple org, dir;
    double t;  ///< infinite for a miss
};

template <class Real>
void check_known(const KnownHit& known, const RenderOptions& options)
{
    const RayScene<Real> scene(parse_scene(known.text, "known", {}), options);
    const Ray<Real> ray = ray_of<Real>(known.org, known.dir);
    CAPTURE(known.text, sizeof(Real), options.isa);
    const SurfaceHit<Real> first = scene.closest_hit(ray);
    const std::vector<SurfaceHit<Real>> all = scene.all_hits(ray);
    const bool hits = std::isfinite(known.t);
    CHECK((first.object == 0) == hits);
    CHECK(all.empty() != hits);
    CHECK(scene.occluded(ray) == hits);
    if (!hits || all.empty())
        return;
    const double allowed = 2.0 * std::numeric_limits<Real>::epsilon() * known.t;
    CHECK(std::abs(static_cast<double>(first.t) - known.t) <= allowed);
    CHECK(std::abs(static_cast<double>(all[0].t) - known.t) <= allowed);
}

void check_known(const std::vector<KnownHit>& hits)
{
    for (const RenderOptions& options : packet_ways())
        if (options.traversal == Traversal::list)
            for (const KnownHit& known : hits) {
                check_known<float>(known, options);
                check_known<double>(known, options);
            }
}

/// The point of a hit, and the origin of a ray that leaves it on the inner side.
template <class Real>
struct InnerStart {
    std::int32_t object = -1;
    std::int32_t surface = no_start;
    Real point[3] = {};
    Real org[3] = {};
};

template <class Real>
InnerStart<Real> inner_start(const RayScene<Real>& scene, const Ray<Real>& ray)
{
    InnerStart<Real> start;
    Real t, normal[3], outer[3];
    HitsView<Real> hit{&t, &start.object, &normal[0], &normal[1], &normal[2]};
    for (int axis = 0; axis < 3; ++axis) {
        hit.point[axis] = &start.point[axis];
        hit.inner_start[axis] = &start.org[axis];
        hit.outer_start[axis] = &outer[axis];
    }
    hit.surface = &start.surface;
    scene.closest_hits({&ray.org[0], &ray.org[1], &ray.org[2], &ray.dir[0], &ray.dir[1],
                        &ray.dir[2], &ray.t_min, &ray.t_max, 1},
                       hit);
    return start;
}

/// An open quadric that its z_range touches at a pole, without its transform.
struct Bowl {
    std::string text;
    double pole, eye;  ///< heights in object space
};

/// Rays from an eye on the axis to the bowl, and from the bowl to its pole.
template <class Real>
void check_pole(const Scene& scene, const Bowl& bowl, const RenderOptions& options)
{
    SceneRandom random(4);
    const RayScene<Real> rays(scene, options);
    const auto world = [&](double x, double y, double z) {
        return Vec3(scene.objects[0].transform * glm::dvec4(x, y, z, 1));
    };
    const Vec3 eye = world(0, 0, bowl.eye);
    for (int i = 0; i < 200; ++i) {
        const double angle = random.between(0.0, 6.28);
        const double away = random.between(0.3, 0.6);
        const double height = bowl.pole + random.between(0.05, 0.2);
        const Vec3 way = world(away * std::cos(angle), away * std::sin(angle), height) - eye;
        const InnerStart<Real> start =
            inner_start(rays, ray_of<Real>({eye.x, eye.y, eye.z}, {way.x, way.y, way.z}));
        REQUIRE(start.object == 0);
        // For double, aims a little beside the pole: at the pole itself rounding may decide.
        const double beside = i % 2 == 0 && sizeof(Real) == sizeof(float) ? 0.0 : 1e-4;
        const Vec3 pole =
            world(random.between(-beside, beside), random.between(-beside, beside), bowl.pole);
        Ray<Real> ray = ray_of<Real>(
            {start.org[0], start.org[1], start.org[2]},
            {pole.x - start.point[0], pole.y - start.point[1], pole.z - start.point[2]});
        const std::int32_t side = ~start.surface;
        Real t;
        std::int32_t object;
        rays.closest_hits({&ray.org[0], &ray.org[1], &ray.org[2], &ray.dir[0], &ray.dir[1],
                           &ray.dir[2], &ray.t_min, &ray.t_max, 1},
                          {{&start.point[0], &start.point[1], &start.point[2]}, &side},
                          {&t, &object});
        CHECK(object == 0);
        CHECK(std::abs(double{t} - 1) < 1e-3);
    }
}

std::string quadric(const std::string& coefficients)
{
    return "quadric { coefficients = (" + coefficients + ") }";
}

constexpr double nowhere = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a clip that touches a pole cuts no hole there", "[exact_starts]")
{
    SceneRandom random(3);
    for (const char* text : {"ellipsoid { z_range = (-1, 0) }", "paraboloid { z_range = (0, 1) }",
                             "cone { z_range = (0, 1) }", "hyperboloid2 { z_range = (1, 2) }",
                             "paraboloid { z_range = (0, 1)  scale = (0.3, 0.3, 0.3)  "
                             "rotate = (1, 2, 3, 40)  rotate = (3, 1, 2, 20) }"}) {
        const Scene scene = parse_scene(text, "bowl", {});
        const Mat3 turn(scene.objects[0].transform);
        for (const RenderOptions& options : packet_ways()) {
            CAPTURE(text, options.isa);
            const RayScene<float> singles(scene, options);
            const RayScene<double> doubles(scene, options);
            for (int i = 0; i < 200; ++i) {
                const Vec3 org = turn * Vec3(0, 0, -random.between(3, 100));
                const Vec3 dir = turn * Vec3(0, 0, random.between(0.1, 3));
                const Triple from{org.x, org.y, org.z};
                const Triple way{dir.x, dir.y, dir.z};
                CHECK(singles.closest_hit(ray_of<float>(from, way)).object == 0);
                CHECK(singles.occluded(ray_of<float>(from, way)));
                CHECK(doubles.closest_hit(ray_of<double>(from, way)).object == 0);
                CHECK(doubles.occluded(ray_of<double>(from, way)));
            }
        }
    }
}

TEST_CASE("a ray from inside a bowl leaves it through its pole too", "[exact_starts]")
{
    const std::string placed = " scale = (0.3, 0.3, 0.4)  rotate = (1, 2, 3, 40) }";
    for (const Bowl& bowl :
         {Bowl{"ellipsoid { z_range = (-1, 0)", -1, 0}, Bowl{"paraboloid { z_range = (0, 1)", 0, 1},
          Bowl{"hyperboloid2 { z_range = (1, 2)", 1, 2}}) {
        const Scene scene = parse_scene(bowl.text + placed, "bowl", {});
        for (const RenderOptions& options : packet_ways()) {
            CAPTURE(bowl.text, options.isa);
            check_pole<float>(scene, bowl, options);
            check_pole<double>(scene, bowl, options);
        }
    }
}

TEST_CASE("a ray from a point of a surface does not hit the surface there", "[exact_starts]")
{
    check_known({{quadric("0,0,1,0,0,0,-1,0,0,0"), {0, -2, 0}, {2, 3, 6}, 1.0 / 18},
                 {quadric("2,2,0,0,0,0,-1,0,0,0"), {0, 0, 2}, {1, -3, -5}, 0.05},
                 {quadric("0,2,1,0,0,0,0,-1,0,0"), {1, 0, 0}, {-2, -5, 0}, nowhere},
                 {quadric("0,2,0,0,0,0,0,-2,0,0"), {-5, 0, -0.5}, {1, -3, 0}, nowhere},
                 {quadric("1,-1,0,0,0,0,0,0,0,0"), {0, 0, 1}, {1, 3, -1}, nowhere},
                 {quadric("1,1,1,0,0,0,0,0,0,-25"), {3, 4, 0}, {1, 2, 2}, nowhere},
                 {quadric("1,1,1,0,0,0,0,0,0,-25"), {3, 4, 0}, {-1, -2, -2}, 22.0 / 9},
                 {"paraboloid { }", {0, 0, 0}, {1, 2, 3}, 0.6}});
}

TEST_CASE("a distant origin along a cylinder does not count as a distance to it", "[exact_starts]")
{
    check_known(
        {{"cylinder { }", {0, 0.25, 1e9}, {-12, -3, -4}, 1.0 / 12 + 0.25 / 3 - 0.25 / 3},
         {"cylinder { }", {0, 0, 65536}, {-3, -4, -12}, 0.2},
         {"quadric { coefficients = (0,0,1,0,0,0,-1,0,0,0) }", {4, 1e9, 0}, {0, 3, 1}, 2.0}});
    for (const RenderOptions& options : packet_ways()) {
        const RayScene<double> walled(
            parse_scene(
                "cylinder { }\nplane { point = (-0.999999999, 0, 0)  normal = (1, 0, 0) }\n",
                "wall", {}),
            options);
        CHECK(walled.closest_hit(ray_of<double>({0, 0.25, 1e9}, {-12, -3, -4})).object == 1);
    }
}

TEST_CASE("coefficients along the world's axes count, however small they are", "[exact_starts]")
{
    const std::string needle = quadric("1,1,1e-13,0,0,0,0,0,0,-1");
    check_known({{needle, {0.5, 0, -1e7}, {0, 0, 1}, 1e7 - std::sqrt(0.75e13)},
                 {needle, {-5, 0, 4e6}, {1, 0, 0}, nowhere}});
}

}  // namespace packtrace::test
