// Rays of any bit pattern: kernels answer, and their answers are in range.
#include "catch.hpp"
#include "lab/stress/placed_quadric.hpp"
#include "lab/stress/stress_random.hpp"
#include "reference_scenes.hpp"
#include "render/ray_columns.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace packtrace::test {
namespace {

template <class Real>
using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

template <class Real>
Real any_bits(lab::StressRandom& random)
{
    return std::bit_cast<Real>(static_cast<Bits<Real>>(random.bits()));
}

/// Any bits at all, or one of the difficult values.
template <class Real>
Real any_value(lab::StressRandom& random)
{
    using Limits = std::numeric_limits<Real>;
    const Real special[] = {0,
                            -Real(0),
                            1,
                            -1,
                            Limits::infinity(),
                            -Limits::infinity(),
                            Limits::quiet_NaN(),
                            Limits::max(),
                            Limits::min(),
                            Limits::denorm_min(),
                            -Limits::denorm_min(),
                            Limits::epsilon()};
    const int kind = random.below(3);
    if (kind == 0)
        return special[random.below(12)];
    return kind == 1 ? any_bits<Real>(random) : static_cast<Real>(random.between(-5.0, 5.0));
}

template <class Real>
RayColumns<Real> any_rays(int count)
{
    lab::StressRandom random(99);
    RayColumns<Real> rays;
    for (int i = 0; i < count; ++i)
        for (auto& column : rays.columns)
            column.push_back(any_value<Real>(random));
    return rays;
}

/// A surface of every kind; `many` adds enough balls for a bvh.
Scene every_kind(bool many)
{
    Scene scene{.objects = {sphere({0, 0, 0}, 1.5), plane({0, -2, 0}, {0.2, 1, 0.1}),
                            sphere({0, -5002, 0}, 5000), sphere({1e5, 0, 0}, 1)}};
    for (int kind = 0; kind < 7; ++kind)
        for (const bool capped : {false, true}) {
            Quadric surface = packtrace::quadric(static_cast<QuadricKind>(kind));
            if (capped)
                surface.z_range = ZRange{-0.5, 0.5};
            surface.capped = capped;
            scene.objects.push_back(
                {.surface = surface,
                 .transform =
                     glm::scale(glm::rotate(glm::translate(Mat4(1.0), {kind - 3.0, 0.5, 1.0}),
                                            0.7 * kind, Vec3(1, 2, 3)),
                                Vec3(1.0, 0.5, kind == 2 ? 1e-3 : 1.0))});
        }
    for (int i = 0; many && i < 60; ++i)
        scene.objects.push_back(sphere({i % 8 - 4.0, i / 8 - 4.0, 3.0}, 0.3));
    return scene;
}

template <class Real>
void answers_are_in_range(const Scene& scene, const RenderOptions& options)
{
    const int n = 3001;
    const RayColumns<Real> rays = any_rays<Real>(n);
    const RayScene<Real> ray_scene(scene, options);
    HitColumns<Real> hits(n);
    hits.object.assign(n, 12345);
    std::vector<std::uint8_t> mask(n, 7);
    ray_scene.closest_hits(rays.view(), hits.view());
    ray_scene.occluded(rays.view(), mask.data());
    const auto objects = static_cast<std::int32_t>(scene.objects.size());
    for (std::size_t i = 0; i < n; ++i) {
        CAPTURE(i);
        CHECK(hits.object[i] >= -1);
        CHECK(hits.object[i] < objects);
        CHECK(mask[i] <= 1);
        bool has_nan = false;
        for (const auto& column : rays.columns)
            has_nan = has_nan || std::isnan(column[i]);
        if (has_nan)
            CHECK(hits.object[i] == -1);
        else if (hits.object[i] >= 0)
            CHECK_FALSE(std::isnan(hits.t[i]));
    }
    ray_scene.all_hits(rays.view(), [&](std::size_t, std::span<const SurfaceHit<Real>> all) {
        for (const SurfaceHit<Real>& hit : all) {
            CHECK(hit.object >= 0);
            CHECK(hit.object < objects);
        }
    });
}

}  // namespace

TEMPLATE_TEST_CASE("rays of any bit pattern get an answer that is in range", "[fuzz_rays]", float,
                   double)
{
    for (const IsaInfo& isa : list_isas())
        for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact})
            for (const SelfHits self_hits : {SelfHits::note, SelfHits::exact})
                for (const bool many : {false, true}) {
                    if (!isa.supported)
                        continue;
                    CAPTURE(isa.name, static_cast<int>(accuracy), many);
                    const RenderOptions options{
                        .isa = isa.name, .accuracy = accuracy, .self_hits = self_hits};
                    answers_are_in_range<TestType>(every_kind(many), options);
                }
}

}  // namespace packtrace::test
