// A caller's coherent rays hit what each ray hits alone, bit for bit.
#include "catch.hpp"
#include "few_objects.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include <packtrace/intersect.hpp>

#include <limits>

namespace packtrace::test {
namespace {

/// Rays of a small picture in packets of neighbours, from the eye or from points around it.
std::vector<Ray<float>> rays_of(const Scene& scene, unsigned seed)
{
    SceneRandom random(seed);
    const int width = 48;
    const int height = 12;
    const CameraBasis basis = camera_basis(scene.camera, width, height);
    const double jitter = seed % 3 == 0 ? 0.0 : std::pow(10.0, random.between(-6, 0));
    const bool ends = seed % 4 == 1;
    std::vector<Ray<float>> rays;
    for (int block = 0; block < width * height / 16; ++block)
        for (int i = 0; i < 16; ++i) {
            const int x = block % (width / 4) * 4 + i % 4;
            const int y = block / (width / 4) * 4 + i / 4;
            const Vec3 dir =
                basis.forward + (x - 0.5 * width) * basis.right + (0.5 * height - y) * basis.up;
            const Vec3 org = basis.origin + jitter * random.inside(Vec3(-1.0), Vec3(1.0));
            Ray<float> ray;
            for (int axis = 0; axis < 3; ++axis) {
                ray.org[axis] = static_cast<float>(org[axis]);
                ray.dir[axis] = static_cast<float>(dir[axis]);
            }
            if (ends) {
                ray.t_min = static_cast<float>(random.between(0.0, 5.0));
                ray.t_max = ray.t_min + static_cast<float>(random.between(0.0, 9.0));
            }
            rays.push_back(ray);
        }
    return rays;
}

}  // namespace

TEST_CASE("coherent rays hit what each ray hits alone", "[common_hits]")
{
    std::size_t found = 0;
    for (unsigned seed = 1; seed <= scene_count(120); ++seed) {
        const Scene scene = FewObjects(seed).scene;
        const std::vector<Ray<float>> rays = rays_of(scene, seed);
        for (const std::string& isa : supported_isas()) {
            const RayScene<float> together(scene, {.isa = isa});
            std::vector<SurfaceHit<float>> hits(rays.size());
            together.closest_hits(RayStructs<float>{rays.data(), rays.size()},
                                  HitStructs<float>{hits.data(), hits.size()});
            CAPTURE(seed, isa);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const SurfaceHit<float> alone = together.closest_hit(rays[i]);
                CAPTURE(i);
                REQUIRE(hits[i].object == alone.object);
                REQUIRE(same_bits(hits[i], alone));
                found += alone.object >= 0;
            }
        }
    }
    CHECK(found > 1000);
}

}  // namespace packtrace::test
