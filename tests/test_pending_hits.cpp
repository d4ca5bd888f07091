// Incoherent rays of a caller, many of which miss, get the same t together as alone, bit for bit:
// hits of different rays are refined together.
#include "catch.hpp"
#include "few_objects.hpp"
#include "render/ray_columns.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include <cmath>
#include <limits>

namespace packtrace::test {
namespace {

/// Rays of which most avoid the middle of the scene. Some end early, and some are NaN.
RayColumns<float> scattered_rays(unsigned seed, std::size_t count)
{
    SceneRandom random(seed);
    RayColumns<float> rays;
    const double spread = std::pow(10.0, random.between(-1.0, 1.0));
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 org = spread * random.inside(Vec3(-2.0), Vec3(2.0));
        Vec3 dir = random.inside(Vec3(-1.0), Vec3(1.0));
        if (i % 3 == 0)
            dir = random.inside(Vec3(-1.0), Vec3(1.0)) - org;
        const float t_min = i % 5 == 1 ? 0.5f : 0.0f;
        const float t_max = i % 7 == 2 ? 3.0f : std::numeric_limits<float>::infinity();
        rays.add(org, i % 101 == 100 ? Vec3(std::nan("")) : dir, t_min, t_max);
    }
    return rays;
}

/// Rays in any direction that leave the hits of other rays, on either side.
RayColumns<float> leaving_rays(const RayScene<float>& queries, const RayColumns<float>& rays,
                               StartColumns<float>& starts)
{
    SceneRandom random(3);
    RayColumns<float> leaving;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        LeftHitColumns<float> hit(1);
        queries.closest_hits(rays.view(i, 1), hit.view());
        if (hit.object[0] < 0)
            continue;
        const bool inside = i % 4 == 3;
        const Vec3 way = random.inside(Vec3(-1.0), Vec3(1.0));
        const bool outwards = glm::dot(way, vector_at(hit.normal, 0)) > 0.0;
        leaving.add(vector_at(inside ? hit.inner_start : hit.outer_start, 0),
                    outwards != inside ? way : -way);
        starts.add(vector_at(hit.point, 0), inside ? ~hit.surface[0] : hit.surface[0]);
    }
    return leaving;
}

/// The number of rays with a hit.
std::size_t check_alone(const RayScene<float>& queries, const RayColumns<float>& rays,
                        const StartColumns<float>* starts = nullptr)
{
    const auto ask = [&](std::size_t first, std::size_t count, const HitsView<float>& hits) {
        if (starts != nullptr)
            queries.closest_hits(rays.view(first, count), starts->view(first), hits);
        else
            queries.closest_hits(rays.view(first, count), hits);
    };
    HitColumns<float> hits(rays.size());
    ask(0, rays.size(), {hits.t.data(), hits.object.data()});
    std::size_t found = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        float t = 0;
        std::int32_t object = 0;
        ask(i, 1, {&t, &object});
        CAPTURE(i);
        REQUIRE(object == hits.object[i]);
        REQUIRE(same_bits(t, hits.t[i]));
        found += object >= 0;
    }
    return found;
}

}  // namespace

TEST_CASE("incoherent rays get the t that each gets alone", "[pending_hits]")
{
    std::size_t found = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const Scene scene = FewObjects(seed).scene;
        // Counts that do not fill the last packet and the last chunk.
        const RayColumns<float> rays = scattered_rays(seed, 200 + 37 * seed % 160);
        CAPTURE(seed);
        for (const std::string& isa : supported_isas()) {
            const RenderOptions options{.isa = isa};
            CAPTURE(isa);
            const RayScene<float> queries(scene, options);
            found += check_alone(queries, rays);
            StartColumns<float> starts;
            const RayColumns<float> leaving = leaving_rays(queries, rays, starts);
            found += check_alone(queries, leaving, &starts);
        }
    }
    CHECK(found > 1000);
}

TEST_CASE("incoherent rays get the t that each gets alone through a bvh of several kinds too",
          "[pending_hits]")
{
    Scene scene = generate_random_spheres({.count = 300, .radius = 0.4, .reflective = 0.0});
    std::size_t others = 0;
    for (const unsigned seed : {7u, 9u})
        for (const Object& object : FewObjects(seed).scene.objects) {
            scene.objects.push_back(object);
            others += !std::holds_alternative<Sphere>(object.surface);
        }
    REQUIRE(others > 1);
    // About a thousand of these rays hit the scene. The compiler chooses the order of the scene's
    // random numbers, so the exact number depends on it.
    const RayColumns<float> rays = scattered_rays(4, 1500);
    for (const std::string& isa : supported_isas()) {
        const RenderOptions options{.isa = isa, .traversal = Traversal::tree};
        CAPTURE(isa);
        const RayScene<float> queries(scene, options);
        const std::size_t found = check_alone(queries, rays);
        CHECK(found > 300);
        CHECK(found < 1400);
        StartColumns<float> starts;
        const RayColumns<float> leaving = leaving_rays(queries, rays, starts);
        CHECK(check_alone(queries, leaving, &starts) > 100);
    }
}

}  // namespace packtrace::test
