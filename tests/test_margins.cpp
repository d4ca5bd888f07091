// The margins of what is left out early, against rays that are looked for near them; their
// proofs are in docs/numerics.md.
#include <cmath>
#include <limits>

#include <packtrace/intersect.hpp>

#include "catch.hpp"
#include "closest_hits.hpp"
#include "lower/pack_stiff.hpp"
#include "render_scene.hpp"
#include "study/stress_family.hpp"

namespace packtrace::test {
namespace {

using study::StressRandom;
using study::Wide;
using study::WideVec;

float single_dot(const glm::vec3& a, const glm::vec3& b)
{
    return std::fma(a.x, b.x, std::fma(a.y, b.y, a.z * b.z));
}

glm::vec3 single_cross(const glm::vec3& a, const glm::vec3& b)
{
    return {std::fma(a.y, b.z, -(a.z * b.y)), std::fma(a.z, b.x, -(a.x * b.z)),
            std::fma(a.x, b.y, -(a.y * b.x))};
}

/// What the kernels compare before they test a stiff object: above 1 the ray is left out.
float rejection(const abi::StiffObject& object, const glm::vec3& org, const glm::vec3& dir)
{
    const glm::vec3 o = org - glm::vec3(object.bound[0], object.bound[1], object.bound[2]);
    const glm::vec3 moment = single_cross(o, dir);
    const float size = std::fma(4.0f * 0x1p-24f, single_dot(o, o), object.bound_radius2);
    return single_dot(moment, moment) / std::fma(single_dot(dir, dir), size, 1e-30f);
}

/// The square of the distance of the ray's line from the centre, over the radius'.
double true_distance2(const LoweredSphere& sphere, const glm::vec3& org, const glm::vec3& dir)
{
    const WideVec o = study::wide(Vec3(org)) - study::wide(sphere.center);
    const WideVec d = study::wide(Vec3(dir));
    const WideVec m = reference::cross(o, d);
    const Wide radius2 = Wide(sphere.radius) * sphere.radius;
    return static_cast<double>(reference::dot(m, m) / (reference::dot(d, d) * radius2));
}

/// A component moved by up to four units in the last place.
float nudged(StressRandom& random, float x)
{
    for (int steps = random.below(4); steps >= 0; --steps)
        x = std::nextafter(
            x, static_cast<float>(random.sign()) * std::numeric_limits<float>::infinity());
    return x;
}

/// Climbs from one ray that meets the sphere to others that do and are nearer to being left out;
/// returns how near it came.
double search(StressRandom& random, double distance, double offset)
{
    LoweredSphere sphere;
    sphere.center = offset * random.unit();
    const abi::StiffObject object = pack_stiff_object(sphere);
    const Vec3 way = random.unit();
    const Vec3 edge = sphere.center + study::across(random, way);
    glm::vec3 org(edge - distance * way);
    glm::vec3 dir(edge - Vec3(org));
    double best = 0.0;
    for (int step = 0; step < 300; ++step) {
        glm::vec3 new_org = org;
        glm::vec3 new_dir = dir;
        const int axis = random.below(6);
        float& moved = axis < 3 ? new_org[axis] : new_dir[axis - 3];
        moved = nudged(random, moved);
        if (true_distance2(sphere, new_org, new_dir) > 1.0)
            continue;
        const auto value = static_cast<double>(rejection(object, new_org, new_dir));
        if (value < best)
            continue;
        best = value;
        org = new_org;
        dir = new_dir;
    }
    return best;
}

/// Small balls near the edges of tiles, where beams end.
Scene balls_at_tile_edges(unsigned seed)
{
    StressRandom random(seed);
    Scene scene;
    scene.width = 64;
    scene.height = 64;
    scene.camera.position = random.box(seed % 2 == 0 ? 1.0 : 1000.0);
    const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
    for (int i = 0; i < 30; ++i) {
        // A pixel at a tile's edge; the ball only just reaches its ray.
        const double x = 16.0 * (random.below(4) - 2) + (random.below(2) == 0 ? 0.0 : 15.0);
        const double y = random.between(-32.0, 32.0);
        const Vec3 dir = basis.forward + x * basis.right + std::floor(y) * basis.up;
        const double radius = random.power(1e-4, 0.05);
        const double miss = radius * (1.0 + random.sign() * random.power(1e-9, 1e-3));
        const Vec3 center = basis.origin + random.between(1.5, 20.0) * dir +
                            miss * study::across(random, glm::normalize(dir));
        scene.objects.push_back(study::sphere_object(center, radius));
    }
    return scene;
}

}  // namespace

TEST_CASE("no ray that meets a stiff ball is left out before its test", "[margins]")
{
    StressRandom random(5);
    double nearest = 0.0;
    for (const double distance : {1.5, 10.0, 1e3, 1e5})
        for (const double offset : {0.0, 1.0, 1e2, 1e4, 1e6})
            for (int start = 0; start < 40; ++start)
                nearest = std::max(nearest, search(random, distance, offset));
    CAPTURE(nearest);
    CHECK(nearest < 1.0);
    // The search gets to within a few times the margin, so it would find a smaller one.
    CHECK(nearest > 1.0 - 64.0 * 0x1p-24);
}

TEST_CASE("a beam leaves out no ball that one of its rays meets", "[margins]")
{
    for (const std::string& isa : supported_isas()) {
        int hits = 0;
        for (unsigned seed = 0; seed < 60; ++seed) {
            CAPTURE(isa, seed);
            const Scene scene = balls_at_tile_edges(seed);
            RenderOptions options;
            options.isa = isa;
            const RayScene<float> by_ray(scene, options);
            const TracingSetup<float> setup(scene);
            for (const TracedRay<float>& traced : trace_closest(kernels_of(isa), setup, scene)) {
                float values[8];
                for (int axis = 0; axis < 3; ++axis) {
                    values[axis] = static_cast<float>(traced.ray.org[axis]);
                    values[3 + axis] = static_cast<float>(traced.ray.dir[axis]);
                }
                values[6] = static_cast<float>(traced.ray.t_min);
                values[7] = std::numeric_limits<float>::infinity();
                const float* v = values;
                float t = 0.0f;
                std::int32_t object = -2;
                by_ray.closest_hits({v, v + 1, v + 2, v + 3, v + 4, v + 5, v + 6, v + 7, 1},
                                    {&t, &object});
                CHECK(object == traced.object);
                hits += object >= 0;
            }
        }
        CHECK(hits > 100);
    }
}

}  // namespace packtrace::test
