// The margins of early culling and the error bounds of decisions in single precision, tested with
// rays aimed near these limits. docs/numerics_derivations.md has the proofs.
#include "catch.hpp"
#include "closest_hits.hpp"
#include "lab/stress/stress_subject.hpp"
#include "render_scene.hpp"
#include "true_hits.hpp"
#include <packtrace/intersect.hpp>

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace packtrace::test {
namespace {

/// The number of a kernel's answers to aimed rays that differ from the truth.
struct WrongAnswers {
    int object = 0;    ///< a hit instead of a miss, or another object
    int t = 0;         ///< more than a unit in the last place off where double decides
    int occluded = 0;  ///< another answer to whether the ray is occluded before its end
    std::string examples;
};

std::string text_of(const StressRay& ray, const AimedTruth& truth, std::int32_t object, float t)
{
    std::ostringstream text;
    text << std::hexfloat << "ray " << ray.org.x << ' ' << ray.org.y << ' ' << ray.org.z << " -> "
         << ray.dir.x << ' ' << ray.dir.y << ' ' << ray.dir.z << std::defaultfloat
         << std::setprecision(10) << ": object " << object << " at " << t << ", truth "
         << truth.object << " at " << truth.t << ", condition " << truth.condition << ", end "
         << truth.t_max << (truth.occluded ? " behind it\n" : " before it\n");
    return text.str();
}

bool right_t(const AimedTruth& truth, float t)
{
    const double ulp = std::ldexp(1.0, std::ilogb(truth.t) - 23);
    return std::abs(static_cast<double>(t) - truth.t) <=
           ulp + double_band * truth.condition * truth.t;
}

WrongAnswers wrong_answers(const AimedRays& aimed, const std::vector<AimedTruth>& truths,
                           const RenderOptions& options)
{
    const RayScene<float> scene(aimed.scene, options);
    RayColumns<float> columns = lab::columns_of<float>(aimed.rays);
    const std::size_t n = columns.size();
    HitColumns<float> hits(n);
    std::vector<std::uint8_t> mask(n);
    scene.closest_hits(columns.view(), hits.view());
    for (std::size_t i = 0; i < n; ++i)
        columns.columns[7][i] = truths[i].t_max;
    scene.occluded(columns.view(), mask.data());
    WrongAnswers wrong;
    for (std::size_t i = 0; i < n; ++i) {
        const AimedTruth& truth = truths[i];
        const std::int32_t object = hits.object[i];
        const bool wrong_object = truth.decidable && object != truth.object;
        const bool wrong_t =
            truth.decidable && object == truth.object && object >= 0 && !right_t(truth, hits.t[i]);
        const bool wrong_mask = truth.occlusion_decidable && (mask[i] == 1) != truth.occluded;
        if ((wrong_object || wrong_t || wrong_mask) && wrong.object + wrong.t + wrong.occluded < 3)
            wrong.examples += text_of(aimed.rays[i], truth, object, hits.t[i]);
        wrong.object += wrong_object;
        wrong.t += wrong_t;
        wrong.occluded += wrong_mask;
    }
    return wrong;
}

/// Checks exact mode against the truth on every instruction set, by lists and by a bvh.
void check_aimed(const AimedFamily& family, int scenes, int rays, std::uint64_t seed)
{
    StressRandom random(seed);
    int decidable = 0;
    for (int number = 0; number < scenes; ++number) {
        AimedRays aimed = family.make(random, rays);
        for (StressRay& ray : aimed.rays) {
            ray.t_min = 0.0;
            ray.t_max = std::numeric_limits<double>::infinity();
            lab::round_to_precision<float>(ray);
        }
        const Truth truth(aimed.scene);
        std::vector<AimedTruth> truths;
        for (const StressRay& ray : aimed.rays) {
            truths.push_back(truth.of(ray, random));
            decidable += truths.back().decidable;
        }
        for (const std::string& isa : supported_isas())
            for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
                const RenderOptions options{.isa = isa, .traversal = traversal};
                const WrongAnswers wrong = wrong_answers(aimed, truths, options);
                CAPTURE(family.name, number, isa, static_cast<int>(traversal), wrong.examples);
                CHECK(wrong.object == 0);
                CHECK(wrong.t == 0);
                CHECK(wrong.occluded == 0);
            }
    }
    // Rays are aimed such that double can decide nearly all of them.
    CHECK(decidable > scenes * rays * 9 / 10);
}

/// Small balls near the edges of tiles, where interval frusta end.
Scene balls_at_tile_edges(unsigned seed)
{
    StressRandom random(seed);
    Scene scene{.width = 64, .height = 64};
    scene.camera.position = random.box(seed % 2 == 0 ? 1.0 : 1000.0);
    const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
    for (int i = 0; i < 30; ++i) {
        // A pixel at a tile's edge; its ray almost touches the ball, from inside or outside.
        const double x = 16.0 * (random.below(4) - 2) + (random.below(2) == 0 ? 0.0 : 15.0);
        const double y = random.between(-32.0, 32.0);
        const Vec3 dir = basis.forward + x * basis.right + std::floor(y) * basis.up;
        const double radius = random.power(1e-4, 0.05);
        const double miss = radius * (1.0 + random.sign() * random.power(1e-9, 1e-3));
        const Vec3 center = basis.origin + random.between(1.5, 20.0) * dir +
                            miss * lab::across(random, glm::normalize(dir));
        scene.objects.push_back(lab::sphere_object(center, radius));
    }
    return scene;
}

}  // namespace

TEST_CASE("exact mode hits what 113 bits say next to silhouettes, creases and rims", "[margins]")
{
    for (const AimedFamily& family : aimed_families())
        check_aimed(family, 10, 300, 5);
}

TEST_CASE("exact mode hits what 113 bits say for hundreds of thousands of aimed rays",
          "[margins][slow]")
{
    for (const AimedFamily& family : aimed_families())
        check_aimed(family, 100, family.name == "many spheres" ? 60 : 500, 1000);
}

TEST_CASE("an interval frustum skips no ball that one of its rays hits", "[margins]")
{
    for (const std::string& isa : supported_isas()) {
        int hits = 0;
        for (unsigned seed = 0; seed < 60; ++seed) {
            CAPTURE(isa, seed);
            const Scene scene = balls_at_tile_edges(seed);
            const RayScene<float> by_ray(scene, {.isa = isa});
            const TracingSetup<float> setup(scene);
            for (const TracedRay<float>& traced : trace_closest(kernels_of(isa), setup, scene)) {
                RayColumns<float> ray;
                ray.add(Vec3(traced.ray.org), Vec3(traced.ray.dir),
                        static_cast<double>(traced.ray.t_min));
                float t = 0.0f;
                std::int32_t object = -2;
                by_ray.closest_hits(ray.view(), {&t, &object});
                CHECK(object == traced.object);
                hits += object >= 0;
            }
        }
        CHECK(hits > 100);
    }
}

}  // namespace packtrace::test
