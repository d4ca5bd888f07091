// Rays next to edges that polygons share, with corners near or far away. With every kernel, each
// ray hits exactly the polygon that 113 bits find.
#include "catch.hpp"
#include "core/quad.hpp"
#include "lab/stress/stress_random.hpp"
#include "lab/stress/stress_subject.hpp"
#include "packet_ways.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/validate.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <vector>

namespace packtrace::test {
namespace {

using lab::StressRandom;
using lab::StressRay;

/// Convex polygons that cover a plane around the world's origin.
struct Tiling {
    std::vector<std::vector<Vec3>> polygons;  ///< lists of corners
    std::vector<std::array<Vec3, 2>> shared;  ///< edges of two polygons each
};

/// A point of a tilted plane, up to the rounding of its height.
Vec3 on_leaning_plane(double x, double y)
{
    return {x, y, 0.3 * x - 0.1 * y - 1.0};
}

/// Triangles around a corner near the origin, with other corners `near` to `far` away.
Tiling fan_of_triangles(StressRandom& random, double near, double far)
{
    constexpr int count = 7;
    const Vec3 middle = on_leaning_plane(random.between(-1, 1), random.between(-1, 1));
    std::vector<Vec3> ring;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 / count * (i + random.between(0.0, 0.7));
        const double distance = random.power(near, far);
        ring.push_back(on_leaning_plane(middle.x + distance * std::cos(angle),
                                        middle.y + distance * std::sin(angle)));
    }
    Tiling tiling;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        tiling.polygons.push_back({middle, ring[i], ring[(i + 1) % ring.size()]});
        tiling.shared.push_back({middle, ring[i]});
    }
    return tiling;
}

/// Four by four quadrilaterals of width `far`, with a corner near the origin.
Tiling grid_of_quadrilaterals(StressRandom& random, double, double far)
{
    const auto corner = [&, x = random.between(-1, 1), y = random.between(-1, 1)](int i, int j) {
        return on_leaning_plane(x + far * ((i - 2) + 0.25 * (j - 2)), y + far * (j - 2));
    };
    Tiling tiling;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            tiling.polygons.push_back(
                {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
            if (j > 0)
                tiling.shared.push_back({corner(i, j), corner(i + 1, j)});
            if (i > 0)
                tiling.shared.push_back({corner(i, j), corner(i, j + 1)});
        }
    return tiling;
}

/// A ray from above the plane to a shared edge, or beside it by 1e-15 to 1e-6 of its distance, with
/// the coordinates rounded to `Real`.
template <class Real>
StressRay ray_next_to_edge(StressRandom& random, const Tiling& tiling)
{
    const auto& [from, to] = random.pick(tiling.shared);
    const double length = glm::length(to - from);
    const double most = random.below(4) == 0 ? 0.9 * length : std::min(0.9 * length, 30.0);
    const Vec3 target = from + random.power(1e-3 * most, most) / length * (to - from);
    Vec3 org = 2.0 * random.unit();
    org.z += 3.0 + 0.3 * org.x - 0.1 * org.y;
    Vec3 dir = target - org;
    if (random.below(4) != 0)
        dir += random.power(1e-15, 1e-6) * glm::length(dir) * random.unit();
    return {Vec3(glm::vec<3, Real>(org)), Vec3(glm::vec<3, Real>(dir)), 0.0,
            std::numeric_limits<double>::infinity()};
}

/// Whether a ray runs down so steeply that rounding cannot turn it upwards.
bool goes_down(const StressRay& ray)
{
    return ray.dir.z - 0.3 * ray.dir.x + 0.1 * ray.dir.y < -1e-10 * glm::length(ray.dir);
}

struct QuadVector {
    Quad x, y, z;
};

/// The sign of (a x b)·d as 1 or -1; 0 if 113 bits cannot decide.
int side_of(const QuadVector& a, const QuadVector& b, const Vec3& d)
{
    const Quad term[6] = {a.y * b.z * d.x,  -a.z * b.y * d.x, a.z * b.x * d.y,
                          -a.x * b.z * d.y, a.x * b.y * d.z,  -a.y * b.x * d.z};
    Quad sum = 0;
    Quad size = 0;
    for (const Quad& x : term) {
        sum += x;
        size += magnitude(x);
    }
    if (magnitude(sum) <= size * 0x1p-106)
        return 0;
    return sum > 0 ? 1 : -1;
}

/// The polygons that a ray may hit: exactly one, unless 113 bits cannot decide.
std::set<std::int32_t> polygons_of(const Tiling& tiling, const StressRay& ray)
{
    std::set<std::int32_t> result;
    for (std::size_t i = 0; i < tiling.polygons.size(); ++i) {
        std::vector<QuadVector> seen;
        for (const Vec3& corner : tiling.polygons[i])
            seen.push_back({Quad(corner.x) - ray.org.x, Quad(corner.y) - ray.org.y,
                            Quad(corner.z) - ray.org.z});
        bool left = true;
        bool right = true;
        for (std::size_t k = 0; k < seen.size(); ++k) {
            const int side = side_of(seen[k], seen[(k + 1) % seen.size()], ray.dir);
            left = left && side >= 0;
            right = right && side <= 0;
        }
        if (left || right)
            result.insert(static_cast<std::int32_t>(i));
    }
    return result;
}

/// Counts of the rays' results.
struct Fared {
    int wrong = 0;
    int none = 0;
    int several = 0;

    void count(const std::set<std::int32_t>& truth, std::size_t hits, std::int32_t first)
    {
        none += hits == 0 || first < 0;
        several += hits > 1;
        wrong += first >= 0 && truth.count(first) == 0;
    }
};

template <class Real>
Fared trace(const Scene& scene, const std::vector<StressRay>& aimed,
            const std::vector<std::set<std::int32_t>>& truth, const RenderOptions& options)
{
    const RayColumns<Real> columns = lab::columns_of<Real>(aimed);
    const RayScene<Real> rays(scene, options);
    std::vector<std::int32_t> first(aimed.size());
    std::vector<Real> t(aimed.size());
    rays.closest_hits(columns.view(), {t.data(), first.data()});
    Fared fared;
    rays.all_hits(columns.view(), [&](std::size_t i, std::span<const SurfaceHit<Real>> hits) {
        fared.count(truth[i], hits.size(), first[i]);
    });
    return fared;
}

template <class Real>
void check_tiling(StressRandom& random, const Tiling& tiling, int count,
                  const std::vector<RenderOptions>& ways)
{
    Scene scene;
    for (const std::vector<Vec3>& corners : tiling.polygons) {
        scene.objects.emplace_back();
        scene.objects.back().surface = Polygon{{corners}};
    }
    validate(scene);
    std::vector<StressRay> aimed;
    std::vector<std::set<std::int32_t>> truth;
    int decidable = 0;
    while (static_cast<int>(aimed.size()) < count) {
        const auto ray = ray_next_to_edge<Real>(random, tiling);
        const std::set<std::int32_t> found = polygons_of(tiling, ray);
        // Far away, rays next to an edge may run along the plane, or past the outermost edges.
        if (!goes_down(ray) || found.empty())
            continue;
        aimed.push_back(ray);
        truth.push_back(found);
        decidable += found.size() == 1 ? 1 : 0;
    }
    CHECK(decidable > count * 9 / 10);
    for (const RenderOptions& options : ways) {
        CAPTURE(options.isa, options.traversal == Traversal::tree);
        const Fared fared = trace<Real>(scene, aimed, truth, options);
        CHECK(fared.wrong == 0);
        CHECK(fared.none == 0);
        CHECK(fared.several == 0);
    }
}

/// Packets on every instruction set, by lists and by a bvh.
template <class Real>
std::vector<RenderOptions> exact_ways()
{
    std::vector<RenderOptions> ways = packet_ways();
    // In single precision the reference also rounds the corners.
    if (sizeof(Real) == sizeof(double))
        ways.push_back({.kernel = Kernel::scalar});
    return ways;
}

}  // namespace

TEMPLATE_TEST_CASE("a ray next to an edge hits the right one of the polygons that share it",
                   "[polygon_edges]", float, double)
{
    const std::vector<RenderOptions> ways = exact_ways<TestType>();
    StressRandom random(81);
    for (const auto tiling : {fan_of_triangles, grid_of_quadrilaterals})
        for (const double far : {1.0, 1e3, 1e6, 1e9})
            for (const double near : {far, 1.0}) {
                CAPTURE(near, far);
                check_tiling<TestType>(random, tiling(random, near, far), 2000, ways);
            }
}

// A ray of whole numbers passes exactly through an edge or a corner.
TEMPLATE_TEST_CASE("a ray through an edge or a corner hits one polygon, the same by every kernel",
                   "[polygon_edges]", float, double)
{
    Scene scene;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const auto corner = [](int x, int y) {
                return Vec3(2.0 * x, 2.0 * y, 4.0 * x - 2.0 * y);
            };
            scene.objects.emplace_back();
            scene.objects.back().surface =
                Polygon{{{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)}}};
        }
    std::vector<StressRay> aimed;
    StressRandom random(82);
    for (int ray = 0; ray < 3000; ++ray) {
        const double x = 1 + random.below(5);
        const double y = 1 + random.below(5);
        Vec3 dir(random.below(9) - 4, random.below(9) - 4, random.below(9) - 4);
        if (dir.z == 2.0 * dir.x - dir.y)
            dir.z += 1.0;
        aimed.push_back({Vec3(x, y, 2.0 * x - y) - 3.0 * dir, dir, 0.0,
                         std::numeric_limits<double>::infinity()});
    }
    const RayColumns<double> columns = lab::columns_of<double>(aimed);
    std::vector<std::set<std::int32_t>> truth;
    RayScene<double>(scene, {.kernel = Kernel::scalar})
        .all_hits(columns.view(), [&](std::size_t, std::span<const SurfaceHit<double>> hits) {
            REQUIRE(hits.size() == 1);
            truth.push_back({hits[0].object});
        });
    for (const RenderOptions& options : packet_ways()) {
        CAPTURE(options.isa, options.traversal == Traversal::tree);
        const Fared fared = trace<TestType>(scene, aimed, truth, options);
        CHECK(fared.wrong == 0);
        CHECK(fared.none == 0);
        CHECK(fared.several == 0);
    }
}

}  // namespace packtrace::test
