// Bodies of polygons are closed: no ray slips through a shared edge.
#include "catch.hpp"
#include "lab/stress/stress_subject.hpp"
#include "polygon_scenes.hpp"
#include "reference_scenes.hpp"
#include "render_scene.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>
#include <packtrace/validate.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace packtrace::test {
namespace {

/// A corner of the cube, a point on an edge, or a point on a face.
Vec3 target(PolygonRandom& random, int ray)
{
    Vec3 point = random.box(1.0);
    for (int axis = 0; axis <= ray % 3; ++axis)
        point[(axis + ray / 3) % 3] = random.between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    return point;
}

/// The number of rays from inside a cube, aimed at its faces, edges and corners, that do not leave
/// it exactly once there.
template <class Real>
int leaks_of_cube(int rays, unsigned seed, const Mat4& m)
{
    PolygonRandom random(seed);
    std::vector<Object> faces = cube_faces();
    for (Object& face : faces)
        face.transform = m;
    const reference::Bodies<Real> bodies(polygon_scene(faces));
    int leaks = 0;
    for (int ray = 0; ray < rays; ++ray) {
        const Vec3 org(m * glm::dvec4(random.box(0.9), 1));
        const Vec3 dir = Vec3(m * glm::dvec4(target(random, ray), 1)) - org;
        const auto hits = reference_hits(bodies, org, dir);
        leaks += hits.size() == 1 && hits[0].leaving && std::abs(hits[0].t - 1) < 1e-3 ? 0 : 1;
    }
    return leaks;
}

double distance_to(const Vec3& org, const Vec3& dir, double t, double radius)
{
    return std::abs(glm::length(org + t * dir) - radius);
}

}  // namespace

TEMPLATE_TEST_CASE("every ray from inside a cube of polygons leaves it once", "[polygon_leaks]",
                   float, double)
{
    CHECK(leaks_of_cube<TestType>(100'000, 11, Mat4(1.0)) == 0);
    PolygonRandom random(13);
    CHECK(leaks_of_cube<TestType>(100'000, 12, some_transform(random)) == 0);
}

TEST_CASE("a million rays aimed at edges and corners leave a cube of polygons once",
          "[polygon_leaks][slow]")
{
    PolygonRandom random(14);
    for (unsigned seed = 0; seed < 10; ++seed) {
        CHECK(leaks_of_cube<double>(50'000, seed, some_transform(random)) == 0);
        CHECK(leaks_of_cube<float>(50'000, seed, some_transform(random)) == 0);
    }
}

TEMPLATE_TEST_CASE("lines from outside hit a cube of polygons twice or not at all",
                   "[polygon_leaks]", float, double)
{
    PolygonRandom random(12);
    const reference::Bodies<TestType> bodies(polygon_scene(cube_faces()));
    int odd = 0;
    int met = 0;
    for (int ray = 0; ray < 100'000; ++ray) {
        const Vec3 org = random.box(1.0) + Vec3(0, 0, ray % 2 == 0 ? 3 : -4);
        const std::size_t hits = reference_hits(bodies, org, target(random, ray) - org).size();
        odd += hits == 0 || hits == 2 ? 0 : 1;
        met += hits == 2 ? 1 : 0;
    }
    CHECK(odd == 0);
    CHECK(met > 30'000);
}

TEST_CASE("a sphere of polygons has no holes, and is closer to a sphere the finer it is",
          "[polygon_leaks]")
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
        const Scene scene = polygon_scene(faces);
        validate(scene);
        const reference::Bodies<double> bodies(scene);
        PolygonRandom random(31);
        double worst = 0.0;
        int leaks = 0;
        for (int ray = 0; ray < 2000; ++ray) {
            const Vec3 org = random.box(0.3);
            const Vec3 dir = ray % 2 == 0 ? random.box(1.0) : point(ray % rings, ray / 7) - org;
            const auto hits = reference_hits(bodies, org, dir);
            leaks += hits.size() == 1 ? 0 : 1;
            if (!hits.empty())
                worst = std::max(worst, distance_to(org, dir, hits[0].t, 1.0));
        }
        CHECK(leaks == 0);
        CHECK(worst < 0.3 * last);
        last = worst;
    }
}

/// Scenes of polygons, some with a bvh.
std::vector<Scene> polygon_scenes()
{
    Scene picture =
        read_scene(std::filesystem::path(PACKTRACE_SOURCE_DIR) / "scenes/polygons.scene");
    picture.width = 64;
    picture.height = 48;
    return {picture};
}

TEST_CASE("packets of doubles render polygons as the reference does", "[polygon_leaks]")
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

/// Traces rays from inside, aimed at corners, edges and elsewhere; each ray must leave exactly
/// once.
template <class Real>
void check_no_leaks(const Scene& scene, const RenderOptions& options, int count,
                    PolygonRandom& random)
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

TEST_CASE("no ray slips between polygons that share an edge", "[polygon_leaks]")
{
    PolygonRandom random(71);
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

// PACKTRACE_POLYGON_RAYS sets a number of rays larger than the suite has time for, such as ten
// million.
TEST_CASE("many rays at edges of a hundred thousand polygons do not slip through",
          "[polygon_leaks][slow]")
{
    const char* const wanted = std::getenv("PACKTRACE_POLYGON_RAYS");
    const int count = wanted != nullptr ? std::atoi(wanted) : 50'000;
    PolygonRandom random(72);
    const Scene scene = facets(160);
    for (int done = 0; done < count; done += 100'000) {
        check_no_leaks<float>(scene, {}, std::min(count - done, 100'000), random);
        check_no_leaks<double>(scene, {}, std::min(count - done, 100'000), random);
    }
}

}  // namespace packtrace::test
