// Refraction in the scalar reference against Snell's law and the rules of the stack of media.
#include "catch.hpp"
#include "reference/glass.hpp"
#include "reference_scenes.hpp"

#include <cmath>
#include <vector>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;
using Ray = reference::Ray<double>;

const double pi = std::acos(-1.0);

// Follows refracted rays only.
class GlassWalk {
public:
    GlassWalk(const std::vector<Object>& objects, const std::vector<double>& iors)
        : world_(scene_of(objects))
    {
        for (const double ior : iors)
            glass_.bodies.push_back({{1, 1, 1}, ior});
    }

    Ray start(const V& org, const V& dir) const
    {
        return {org, reference::normalize(dir), glass_.stack_at(world_.bodies, org, dir)};
    }

    // The ray behind the next surface; fails if there is no surface.
    Ray step(const Ray& ray) const
    {
        const auto at = closest_surface(world_, ray);
        REQUIRE(at.has_value());
        const auto next = glass_.refraction_ray(ray, *at);
        REQUIRE(next.has_value());
        return *next;
    }

    bool totally_reflects(const Ray& ray) const
    {
        const auto at = closest_surface(world_, ray);
        REQUIRE(at.has_value());
        return !glass_.refraction_ray(ray, *at).has_value();
    }

private:
    static Scene scene_of(const std::vector<Object>& objects)
    {
        return {.objects = objects};
    }

    reference::World<double> world_;
    reference::Glass<double> glass_;
};

// Glass between z = -1 and z = 1.
Object glass_slab()
{
    return quadric({0, 0, 1, 0, 0, 0, 0, 0, 0, -1});
}

// The sine of the angle between a unit direction and the z axis.
double sine(const Ray& ray)
{
    return std::hypot(ray.dir.x, ray.dir.y);
}

}  // namespace

TEST_CASE("refraction obeys Snell's law and stays in the plane of incidence", "[reference_glass]")
{
    const V D(0.6, 0, 0.8);
    const auto T = reference::refract(D, V(0, 0, -1), 1.0, 1.5);
    REQUIRE(T.has_value());
    check_color(*T, Rgb(0.4, 0, std::sqrt(1 - 0.16)));
    const auto straight = reference::refract(V(0, 0, 1), V(0, 0, -1), 1.0, 2.4);
    check_color(*straight, Rgb(0, 0, 1));
}

TEST_CASE("total internal reflection begins at the critical angle", "[reference_glass]")
{
    // Out of a half space of glass behind the plane z = 0.
    const GlassWalk walk({plane({0, 0, 0}, {0, 0, 1})}, {1.5});
    const double critical = std::asin(1 / 1.5);
    const auto below = [&](double angle) {
        return walk.start({0, 0, -1}, {std::sin(angle), 0, std::cos(angle)});
    };
    CHECK_FALSE(walk.totally_reflects(below(critical - 1e-6)));
    CHECK(walk.totally_reflects(below(critical + 1e-6)));
    // Just below the critical angle the ray leaves along the surface.
    CHECK(sine(walk.step(below(critical - 1e-6))) == Approx(1.0).epsilon(1e-5));
    // On the way into the glass there is no total reflection.
    CHECK_FALSE(walk.totally_reflects(walk.start({0, 0, 1}, {1, 0, -1e-3})));
}

TEST_CASE("a slab shifts a ray by the analytic amount and keeps its direction", "[reference_glass]")
{
    const GlassWalk walk({glass_slab()}, {1.5});
    for (const double degrees : {0.0, 10.0, 45.0, 80.0}) {
        const double angle = degrees * pi / 180;
        const V dir(std::sin(angle), 0, std::cos(angle));
        const Ray out = walk.step(walk.step(walk.start({0, 0, -3}, dir)));
        check_color(out.dir, Rgb(dir.x, dir.y, dir.z));
        CHECK(out.inside.top() == reference::GlassStack::outside);
        const double within = std::asin(std::sin(angle) / 1.5);
        const double shift = 2 * std::sin(angle - within) / std::cos(within);
        CHECK(length(cross(out.org - V(0, 0, -3), dir)) == Approx(shift).margin(1e-13));
    }
}

TEST_CASE("in nested glass the ior of the innermost medium counts", "[reference_glass]")
{
    // A slab of 1.3 holds one of 1.8, half as thick. n sin stays 0.5 throughout.
    Object inner = glass_slab();
    inner.transform[2][2] = 0.5;
    const GlassWalk walk({glass_slab(), inner}, {1.3, 1.8});
    Ray ray = walk.start({0, 0, -3}, {0.5, 0, std::sqrt(0.75)});
    const std::vector<double> media = {1.3, 1.8, 1.3, 1.0};
    const std::vector<int> tops = {0, 1, 0, -1};
    for (std::size_t i = 0; i < media.size(); ++i) {
        ray = walk.step(ray);
        CHECK(sine(ray) == Approx(0.5 / media[i]).epsilon(1e-14));
        CHECK(ray.inside.top() == tops[i]);
    }
}

TEST_CASE("leaving a body deeper in the stack does not refract the ray", "[reference_glass]")
{
    // The second slab extends from z = 0 to z = 2: entered after the first, left after it.
    Object second = glass_slab();
    second.transform[3][2] = 1.0;
    const GlassWalk walk({glass_slab(), second}, {1.3, 1.8});
    Ray ray = walk.start({0, 0, -3}, {0.5, 0, std::sqrt(0.75)});
    const std::vector<double> media = {1.3, 1.8, 1.8, 1.0};
    for (const double medium : media) {
        ray = walk.step(ray);
        CHECK(sine(ray) == Approx(0.5 / medium).epsilon(1e-14));
    }
    CHECK(ray.org.z == Approx(2.0));
}

TEST_CASE("an eye inside glass starts with the media around it", "[reference_glass]")
{
    // The inner medium is on top, whichever comes first in the scene.
    const GlassWalk inner_first({sphere({0, 0, 0}, 1), sphere({0, 0, 0}, 3)}, {1.8, 1.3});
    CHECK(inner_first.start({0, 0, 0}, {0, 0, 1}).inside.top() == 0);
    const GlassWalk outer_first({sphere({0, 0, 0}, 3), sphere({0, 0, 0}, 1)}, {1.3, 1.8});
    const Ray ray = outer_first.start({0, 0, 0}, {0, 0, 1});
    CHECK(ray.inside.top() == 1);
    CHECK(ray.inside.contains(0));
    CHECK(outer_first.start({0, 0, 2}, {0, 0, 1}).inside.top() == 0);
    CHECK(outer_first.start({0, 0, 4}, {0, 0, 1}).inside.top() == reference::GlassStack::outside);
    // From between the two, out of the outer one: n sin goes from 1.3 to 1.
    const GlassWalk pool({glass_slab(), sphere({0, 0, 9}, 1)}, {1.3, 1.8});
    CHECK(sine(pool.step(pool.start({0, 0, 0}, {0.5, 0, std::sqrt(0.75)}))) ==
          Approx(0.65).epsilon(1e-14));
}

TEST_CASE("an open glass surface around the eye ends at its z range", "[reference_glass]")
{
    // A ray along the tube leaves it at z = 1, long before the ball around it.
    Object tube = quadric({1, 1, 0, 0, 0, 0, 0, 0, 0, -1});
    std::get<Quadric>(tube.surface).z_range = ZRange{-1, 1};
    for (const double forward : {1.0, -1.0}) {
        const GlassWalk walk({tube, sphere({0, 0, 0}, 3)}, {1.8, 1.3});
        CHECK(walk.start({0, 0, 0}, {0, 0, forward}).inside.top() == 0);
        // Through its side the ray leaves it first, too.
        CHECK(walk.start({0, 0, 0}, {1, 0, 0}).inside.top() == 0);
    }
}

TEST_CASE("an open glass surface entered through its open end does not refract the ray",
          "[reference_glass]")
{
    Object tube = quadric({1, 1, 0, 0, 0, 0, 0, 0, 0, -1});
    std::get<Quadric>(tube.surface).z_range = ZRange{-1, 1};
    const GlassWalk walk({tube}, {1.5});
    const Ray ray = walk.start({0, 0, -2}, {0.5, 0, 1});
    const Ray out = walk.step(ray);
    check_color(out.dir, Rgb(ray.dir.x, ray.dir.y, ray.dir.z));
    CHECK(out.inside.top() == reference::GlassStack::outside);
}

TEST_CASE("a ninth medium around the ray is not recorded and does not refract the ray",
          "[reference_glass]")
{
    std::vector<Object> shells;
    std::vector<double> iors;
    for (int i = 0; i < 9; ++i) {
        Object shell = glass_slab();
        shell.transform[2][2] = 9 - i;
        shells.push_back(shell);
        iors.push_back(1.1 + 0.1 * i);
    }
    const GlassWalk walk(shells, iors);
    Ray ray = walk.start({0, 0, -20}, {0.5, 0, std::sqrt(0.75)});
    for (int i = 0; i < 8; ++i)
        ray = walk.step(ray);
    CHECK(sine(ray) == Approx(0.5 / 1.8).epsilon(1e-13));
    for (int i = 0; i < 2; ++i) {
        ray = walk.step(ray);
        CHECK(sine(ray) == Approx(0.5 / 1.8).epsilon(1e-13));
    }
    for (int i = 0; i < 8; ++i)
        ray = walk.step(ray);
    CHECK(sine(ray) == Approx(0.5).epsilon(1e-13));
    CHECK(ray.inside.top() == reference::GlassStack::outside);
}

}  // namespace packtrace::test
