#include "catch.hpp"
#include "refusal.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include <packtrace/build.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>

#include <cmath>
#include <random>
#include <vector>

// RayScene::update(): moved objects get the answers of a new RayScene, bit for bit.
namespace packtrace::test {
namespace {

class Swarm {
public:
    Swarm()
    {
        for (int i = 0; i < 900; ++i)
            add(packtrace::sphere(place(), 0.05 + 0.1 * share()));
        for (int i = 0; i < 40; ++i) {
            add(clip_and_cap(cylinder(), -0.5, 0.5));
            add(ellipsoid());
            add(packtrace::polygon({{0, 0, 0}, {0.5, 0, 0}, {0.3, 0.4, 0}}));
        }
        for (std::size_t i = 900; i < scene.objects.size(); ++i)
            scene.objects[i] = packtrace::translate(
                packtrace::scale(std::move(scene.objects[i]), Vec3(0.1, 0.2, 0.3)), place());
        add(packtrace::plane({0, -3, 0}, {0, 1, 0}));
        add(packtrace::sphere({0, -5003, 0}, 5000));
    }

    /// Moves each of the first `count` objects a little; returns their numbers.
    std::vector<std::int32_t> step(std::size_t count, double size = 0.05)
    {
        std::vector<std::int32_t> moved;
        for (std::size_t i = 0; i < count; ++i) {
            Object& object = scene.objects[i];
            auto* const ball = std::get_if<Sphere>(&object.surface);
            const Vec3 by = size * place();
            if (ball != nullptr && i % 2 == 0)
                ball->center += by;
            else
                object =
                    packtrace::translate(packtrace::rotate(std::move(object), {0, 1, 0}, 0.2), by);
            moved.push_back(static_cast<std::int32_t>(i));
        }
        return moved;
    }

    Scene scene;
    static constexpr std::size_t movable = 1020;

private:
    void add(Surface surface)
    {
        scene.objects.push_back(make_object(std::move(surface)));
    }
    double share()
    {
        return random_.between(0.0, 1.0);
    }
    Vec3 place()
    {
        return random_.inside(Vec3(-3.0), Vec3(3.0));
    }

    SceneRandom random_{17};
};

template <class Real>
std::vector<Ray<Real>> rays_about(std::size_t count)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<Real> place(Real(-4), Real(4));
    std::vector<Ray<Real>> rays(count);
    for (Ray<Real>& ray : rays)
        for (int axis = 0; axis < 3; ++axis) {
            ray.org[axis] = place(random);
            ray.dir[axis] = Real(0.3) * place(random) - Real(0.3) * ray.org[axis];
        }
    return rays;
}

/// All answers of a RayScene for some rays.
template <class Real>
struct Answers {
    std::vector<SurfaceHit<Real>> closest;
    std::vector<std::uint8_t> mask;
    std::vector<SurfaceHit<Real>> all;
    std::vector<HitBounds> bounds;

    Answers(const RayScene<Real>& scene, const std::vector<Ray<Real>>& rays)
        : closest(rays.size()), mask(rays.size())
    {
        scene.closest_hits(rays, closest);
        scene.occluded(rays, mask);
        scene.all_hits(
            rays, [&](std::size_t, auto hits) { all.insert(all.end(), hits.begin(), hits.end()); });
        for (std::size_t i = 0; i < rays.size(); i += 16)
            bounds.push_back(scene.bound_closest_hit(rays[i], closest[i].object));
    }

    /// Compares bits.
    bool operator==(const Answers& other) const
    {
        return same_bits(closest, other.closest) && mask == other.mask &&
               same_bits(all, other.all) && same_bits(bounds, other.bounds);
    }
};

template <class Real>
void check_steps(const RenderOptions& options)
{
    Swarm swarm;
    const auto rays = rays_about<Real>(1500);
    RayScene<Real> moving(swarm.scene, options);
    const Answers<Real> before(moving, rays);
    for (int step = 0; step < 5; ++step) {
        CAPTURE(step);
        const auto moved = swarm.step(step % 2 == 0 ? Swarm::movable : 300, 0.02);
        const SceneUpdate done = moving.update(swarm.scene, moved);
        CHECK(done.rebuilt == (step == 0));
        CHECK(done.cost > 0.9);
        const Answers<Real> now(moving, rays);
        CHECK(now == Answers<Real>(RayScene<Real>(swarm.scene, options), rays));
        CHECK_FALSE(now == before);
    }
}

std::string refusal_of_update(RayScene<double>& rays, const Scene& scene,
                              const std::vector<std::int32_t>& moved)
{
    return refusal([&] { return rays.update(scene, moved); });
}

}  // namespace

TEST_CASE("objects that move in small steps give the answers of a new scene", "[scene_update]")
{
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        RenderOptions options{.isa = isa};
        check_steps<float>(options);
        check_steps<double>(options);
        options.accuracy = Accuracy::fast;
        check_steps<float>(options);
    }
}

TEST_CASE("objects that cast no shadow move, too", "[scene_update]")
{
    Swarm swarm;
    swarm.scene.objects[7].casts_shadow = false;
    const auto rays = rays_about<float>(1000);
    RayScene<float> moving(swarm.scene);
    (void)moving.update(swarm.scene, swarm.step(10));
    CHECK_FALSE(moving.update(swarm.scene, swarm.step(10)).rebuilt);
    CHECK(Answers<float>(moving, rays) == Answers<float>(RayScene<float>(swarm.scene), rays));
}

TEST_CASE("lights, and the objects that cast shadows, stay those of the first scene",
          "[scene_update]")
{
    // Under a roof of many balls, and of one large ball that casts no shadow.
    Scene scene;
    for (int i = 0; i < 100; ++i)
        scene.objects.push_back(
            make_object(packtrace::sphere({i % 10 - 4.5, 1, i / 10 - 4.5}, 0.75)));
    scene.objects.push_back(make_object(packtrace::sphere({0, -1, 20}, 2)));
    scene.objects.back().casts_shadow = false;
    scene.lights = {ambient_light(Rgb(0.1)), point_light({0, 9, 0}, Rgb(0.5)),
                    point_light({0, 0, 3}, Rgb(0.5)), point_light({0, 0, 40}, Rgb(0.5))};
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar}) {
        CAPTURE(static_cast<int>(kernel));
        RayScene<float> moving(scene, {.kernel = kernel});
        const float origin[] = {0};
        const auto lit = [&](std::size_t light) {
            std::uint8_t mask = 2;
            moving.lit({{origin, origin, origin}, nullptr, 1}, light, &mask);
            return int{mask};
        };
        Scene moved = scene;
        moved.lights.clear();
        moved.shadows = ShadowKind::none;
        for (Object& object : moved.objects)
            object.casts_shadow = !object.casts_shadow;
        for (int step = 0; step < 3; ++step) {
            CAPTURE(step);
            CHECK(lit(1) == 0);
            CHECK(lit(2) == 1);
            CHECK(lit(3) == 1);
            moved.objects[55] =
                packtrace::translate(std::move(moved.objects[55]), Vec3(0.01, 0, 0));
            const SceneUpdate done = moving.update(moved);
            CHECK(done.rebuilt == (step == 0 || kernel == Kernel::scalar));
        }
        CHECK(lit(1) == 0);
        CHECK(lit(3) == 1);
    }
}

TEST_CASE("the bvh is rebuilt when objects change their kind or scatter", "[scene_update]")
{
    Swarm swarm;
    const auto rays = rays_about<double>(1000);
    RayScene<double> moving(swarm.scene);
    (void)moving.update(swarm.scene, swarm.step(5));
    const auto check = [&](const std::vector<std::int32_t>& moved, bool rebuilt) {
        const SceneUpdate done = moving.update(swarm.scene, moved);
        CHECK(done.rebuilt == rebuilt);
        CHECK(Answers<double>(moving, rays) ==
              Answers<double>(RayScene<double>(swarm.scene), rays));
    };
    auto& objects = swarm.scene.objects;
    check(swarm.step(5), false);
    // A sphere becomes an ellipsoid and moves as one.
    objects[3] = packtrace::scale(std::move(objects[3]), Vec3(1, 2, 1));
    check({3}, true);
    objects[3] = packtrace::translate(std::move(objects[3]), Vec3(0.1, 0, 0));
    check({3}, false);
    // Surfaces that a bvh does not contain.
    objects[Swarm::movable] =
        packtrace::translate(std::move(objects[Swarm::movable]), Vec3(0, 1, 0));
    check({static_cast<std::int32_t>(Swarm::movable)}, true);
    objects[0].surface = packtrace::sphere({0, -5000.5, 0}, 5000);
    check({0}, true);
    objects[0].surface = packtrace::sphere({0, 1, 0}, 0.1);
    check({0}, true);
    // Large steps scatter the objects.
    check(swarm.step(900, 1.0), true);
    check(swarm.step(900, 0.001), false);
}

TEST_CASE("an update finds the moved objects by itself", "[scene_update]")
{
    Swarm swarm;
    const auto rays = rays_about<float>(1000);
    RayScene<float> moving(swarm.scene);
    CHECK_FALSE(moving.update(swarm.scene).rebuilt);
    (void)swarm.step(Swarm::movable);
    CHECK(moving.update(swarm.scene).rebuilt);
    // The plane and the ground do not move, so the bvh can be refitted.
    (void)swarm.step(Swarm::movable, 0.01);
    CHECK_FALSE(moving.update(swarm.scene).rebuilt);
    CHECK(Answers<float>(moving, rays) == Answers<float>(RayScene<float>(swarm.scene), rays));
    CHECK(moving.update(swarm.scene).cost == 1.0);
}

TEST_CASE("the scalar kernel and scenes of few objects follow updates", "[scene_update]")
{
    Scene scene{.objects = {make_object(packtrace::sphere({0, 0, 0}, 1)),
                            make_object(packtrace::plane({0, -2, 0}, {0, 1, 0}))}};
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar}) {
        RayScene<double> moving(scene, {.kernel = kernel});
        Scene moved = scene;
        moved.objects[0] = packtrace::translate(moved.objects[0], {0, 0, 5});
        CHECK(moving.update(moved, std::vector<std::int32_t>{0, 0}).rebuilt);
        CHECK(moving.closest_hit({.org = {0, 0, -3}, .dir = {0, 0, 1}}).t == Approx(7.0));
        CHECK(moving.update(moved).rebuilt == false);
    }
}

TEST_CASE("an invalid update is refused and changes nothing", "[scene_update]")
{
    Swarm swarm;
    const auto rays = rays_about<double>(500);
    RayScene<double> moving(swarm.scene);
    (void)moving.update(swarm.scene, swarm.step(5));
    const Answers<double> before(moving, rays);
    Scene bad = swarm.scene;
    std::get<Sphere>(bad.objects[4].surface).radius = -1;
    bad.objects[2] = packtrace::translate(std::move(bad.objects[2]), Vec3(1, 0, 0));
    CHECK(refusal_of_update(moving, bad, {2, 4}) ==
          "sphere 5: 'radius' is -1; use a number above 0");
    CHECK(refusal_of_update(moving, swarm.scene, {-1}) ==
          "update: no object has the number -1; there are 1022, from 0 on");
    CHECK_THAT(refusal_of_update(moving, swarm.scene, {1022}), ContainsSubstring("number 1022"));
    bad.objects.pop_back();
    CHECK(refusal_of_update(moving, bad, {2}) ==
          "update: the scene has 1021 objects, the RayScene was made of 1022; make a new RayScene");
    CHECK(Answers<double>(moving, rays) == before);
    CHECK_FALSE(moving.update(swarm.scene, swarm.step(5)).rebuilt);
}

}  // namespace packtrace::test
