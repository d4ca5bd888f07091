// Proven bounds of hits contain the true hits.
#include "catch.hpp"
#include "core/quad.hpp"
#include "intersect_program.hpp"
#include "lab/stress/stress_family.hpp"
#include "lab/stress/stress_subject.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace packtrace::test {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// One ray for a scene, and the bounds of its hits.
template <class Real>
class OneRay {
public:
    OneRay(const Vec3& org, const Vec3& dir, double t_min = 0.0, double t_max = endless)
    {
        ray_.add(org, dir, t_min, t_max);
    }

    /// The bounds of the closest hit, which is on this object.
    [[nodiscard]] HitBounds first(const RayScene<Real>& scene, std::int32_t object = 0) const
    {
        HitBounds bounds;
        scene.bound_closest_hits(ray_.view(), &object, &bounds);
        return bounds;
    }

    /// The bounds of all hits.
    [[nodiscard]] std::vector<HitBounds> all(const RayScene<Real>& scene) const
    {
        std::vector<HitBounds> bounds;
        scene.all_hits(ray_.view(), [&](std::size_t ray, std::span<const SurfaceHit<Real>> hits) {
            bounds.resize(hits.size());
            scene.bound_all_hits(ray_.view(), ray, hits, bounds);
        });
        return bounds;
    }

private:
    RayColumns<Real> ray_;
};

bool holds(const HitBounds& bounds, double t)
{
    return bounds.low <= t && t <= bounds.high;
}

/// The distance between bounds, in units in the last place of double.
double ulps(const HitBounds& bounds)
{
    return (bounds.high - bounds.low) / std::ldexp(0x1p-52, std::ilogb(bounds.low));
}

Scene scene_of(const std::string& text)
{
    return parse_scene(text, "scene");
}

Scene scene_of(Object object)
{
    Scene scene;
    scene.objects.push_back(std::move(object));
    return scene;
}

using Rational = boost::multiprecision::cpp_rational;

/// The side of a sphere without a transform on which a ray's point at t lies, in exact arithmetic.
int side_of(const Sphere& sphere, const Vec3& org, const Vec3& dir, double t)
{
    Rational value = -Rational(sphere.radius) * Rational(sphere.radius);
    for (int axis = 0; axis < 3; ++axis) {
        const Rational w =
            Rational(org[axis]) + Rational(t) * Rational(dir[axis]) - Rational(sphere.center[axis]);
        value += w * w;
    }
    return value.sign();
}

/// Below 0 if the ray's line certainly misses the sphere.
int discriminant_of(const Sphere& sphere, const Vec3& org, const Vec3& dir)
{
    Rational a = 0;
    Rational b = 0;
    Rational c = -Rational(sphere.radius) * Rational(sphere.radius);
    for (int axis = 0; axis < 3; ++axis) {
        const Rational w = Rational(org[axis]) - Rational(sphere.center[axis]);
        a += Rational(dir[axis]) * Rational(dir[axis]);
        b += w * Rational(dir[axis]);
        c += w * w;
    }
    return Rational(b * b - a * c).sign();
}

lab::StressGroup group_of(const lab::StressFamily& family, int rays, std::uint64_t seed)
{
    std::vector<lab::StressGroup> groups = lab::make_groups<double>(family, seed, rays);
    return groups.front();
}

template <class Real>
lab::BoundChecks check_family(const lab::StressFamily& family, int rays, std::uint64_t seed)
{
    lab::BoundChecks sum;
    const lab::StressSubject subject{"packet", "exact", "auto", true, {}};
    for (const lab::StressGroup& group : lab::make_groups<Real>(family, seed, rays))
        sum.add(lab::check_bounds<Real>(subject, group));
    return sum;
}

/// Checks this number of rays in each family; returns the number of bounds.
std::uint64_t check_families(int rays, std::uint64_t seed)
{
    std::uint64_t bounds = 0;
    for (const lab::StressFamily& family : lab::stress_families()) {
        CAPTURE(family.name, seed);
        lab::BoundChecks single = check_family<float>(family, rays, seed);
        CHECK(single.missed == 0);
        lab::BoundChecks wide = check_family<double>(family, rays, seed);
        CHECK(wide.missed == 0);
        bounds += single.bounds + wide.bounds;
    }
    return bounds;
}

}  // namespace

TEST_CASE("bounds of a plain hit are a few units in the last place of double apart", "[hit_bounds]")
{
    const Scene scene = scene_of(hand_scene);
    const RayScene<double> doubles(scene);
    const RayScene<float> floats(scene);
    const HitBounds ball = OneRay<double>({0, 0, 0}, {0, 0, 1}).first(doubles);
    CHECK(holds(ball, 4.0));
    CHECK(ulps(ball) <= 3.0);
    const HitBounds single = OneRay<float>({0, 0, 0}, {0, 0, 1}).first(floats);
    CHECK(single.low == ball.low);
    CHECK(single.high == ball.high);
    CHECK(holds(OneRay<double>({0, 0, 0}, {0, -1, 0}).first(doubles, 1), 2.0));
    CHECK(holds(OneRay<double>({10.5, 0, -5}, {0, 0, 0.5}).first(doubles, 2), 8.0));
    // From inside, and beyond t_min.
    CHECK(holds(OneRay<double>({0, 0, 5}, {0, 0, 2}).first(doubles), 0.5));
    CHECK(holds(OneRay<double>({0, 0, 0}, {0, 0, 1}, 4.5).first(doubles), 6.0));
}

TEST_CASE("bounds are empty for a miss", "[hit_bounds]")
{
    const RayScene<double> scene(scene_of(hand_scene));
    CHECK(OneRay<double>({0, 0, 0}, {0, 0, 1}).first(scene, -1).empty());
    CHECK(OneRay<double>({0, 0, 0}, {0, 0, 1}, 0.0, 3.0).first(scene).empty());
    CHECK(OneRay<double>({0, 0, 0}, {0, 0, 1}, 7.0).first(scene).empty());
    CHECK(OneRay<double>({0, 0, 0}, {0, 1, 0}).first(scene).empty());
    CHECK(OneRay<double>({0, 0, 0}, {0, 0, 0}).first(scene).empty());
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    CHECK(OneRay<double>({none, 0, 0}, {0, 0, 1}).first(scene).empty());
    CHECK(OneRay<double>({0, 0, 0}, {0, none, 1}).first(scene).empty());
    CHECK(OneRay<double>({0, 0, 0}, {0, 0, 1}, none).first(scene).empty());
    CHECK(OneRay<double>({0, 0, 0}, {0, 0, 1}, 0.0, none).first(scene).empty());
    // The ray passes the ball by less than single precision resolves.
    CHECK(OneRay<double>({1.0 + 0x1p-50, 0, 0}, {0, 0, 1}).first(scene).empty());
}

TEST_CASE("bounds are empty for one of all hits that only rounding moved into the ray interval",
          "[hit_bounds]")
{
    const RayScene<double> scene(scene_of(hand_scene));
    Ray<double> ray{.org = {0, 0, 0}, .dir = {0, 0, 1}};
    const std::vector<SurfaceHit<double>> hits = scene.all_hits(ray);
    REQUIRE(hits.size() == 2);
    ray.t_max = 6.0;
    std::vector<HitBounds> bounds = scene.bound_all_hits(ray, hits);
    CHECK(holds(bounds[0], 4.0));
    CHECK(bounds[1].empty());
    ray = {.org = {0, 0, 0}, .dir = {0, 0, 1}, .t_min = 4.0};
    bounds = scene.bound_all_hits(ray, hits);
    CHECK(bounds[0].empty());
    CHECK(holds(bounds[1], 6.0));
}

TEST_CASE("bounds contain the nearer of two hits that single precision cannot tell apart",
          "[hit_bounds]")
{
    const Scene scene = scene_of(lab::sphere_object({0, 0, 10000}, 0.0003));
    const RayScene<float> tiny(scene);
    const OneRay<float> ray({0, 0, 0}, {1e-8, 1e-8, 1});
    const HitBounds first = ray.first(tiny);
    CHECK(first.high < 10000.0);
    CHECK(ulps(first) <= 3.0);
    const auto all = ray.all(tiny);
    REQUIRE(all.size() == 2);
    CHECK(all[0].high < 10000.0);
    CHECK(all[1].low > 10000.0);
}

TEST_CASE("bounds of a ray that only touches contain the point of contact", "[hit_bounds]")
{
    const RayScene<double> scene(scene_of(hand_scene));
    const HitBounds touch = OneRay<double>({1, 0, 0}, {0, 0, 1}).first(scene);
    CHECK(holds(touch, 5.0));
    CHECK(touch.high - touch.low < 1e-14);
}

TEST_CASE("bounds at a rim are one interval", "[hit_bounds]")
{
    // Whether the ray hits the side or the cap is in doubt there; that it leaves the body is
    // certain.
    const RayScene<double> scene(scene_of("cylinder { z_range = (-1, 1)  capped = true }"));
    const HitBounds rim = OneRay<double>({0.5, 0, 0}, {0.5, 0, 1}).first(scene);
    CHECK(holds(rim, 1.0));
    CHECK(rim.high - rim.low < 1e-14);
    const HitBounds axis = OneRay<double>({0.5, 0, 0}, {0, 0, -0.5}).first(scene);
    CHECK(holds(axis, 2.0));
    CHECK(axis.high - axis.low < 1e-14);
}

TEST_CASE("bounds of a ray along the caps of a stretched body are tight", "[hit_bounds]")
{
    const RayScene<double> cylinder(
        scene_of("cylinder { z_range=(0, 1) capped=yes scale=(1.1, 1.3, 1.7) }"));
    const HitBounds side = OneRay<double>({5, 0, 0.1}, {-1, 0, 0}).first(cylinder);
    CHECK(holds(side, 3.9));
    CHECK(ulps(side) <= 3.0);
    const RayScene<float> slice(scene_of("ellipsoid { z_range=(-0.5, 0.5) capped=yes scale=0.3 }"));
    CHECK(OneRay<float>({5, 0, 0.125}, {0, -1, 0}).first(slice).empty());
    CHECK(ulps(OneRay<float>({0, 5, 0.125}, {0, -1, 0}).first(slice)) <= 3.0);
}

TEST_CASE("two hits with one t in single precision have their own bounds", "[hit_bounds]")
{
    // Rays along an asymptote hit the side once, and the cap next to the rim.
    const RayScene<float> waist(
        scene_of("hyperboloid { z_range = (-1, 1)  capped = true  scale = 1.1 }"));
    const float z = -9.89999962f;
    const double cap = 1.1 - double{z};
    int apart = 0;
    for (int i = 0; i < 24; ++i) {
        CAPTURE(i);
        const float x = -12.5556374f + 0x1p-20f * static_cast<float>(i);
        const auto all = OneRay<float>({x, 0, z}, {1, 0, 1}).all(waist);
        if (all.size() != 2 || all[0].high >= all[1].low)
            continue;
        ++apart;
        // ((x + t) - (z + t)) ((x + t) + (z + t)) = 1.1²
        const Quad difference = Quad(x) - Quad(z);
        const Quad side = (Quad(1.1) * Quad(1.1) / difference - Quad(x) - Quad(z)) / 2;
        const auto rounded = static_cast<double>(side);
        CHECK(holds(all[side < cap ? 0 : 1], rounded));
        CHECK(holds(all[side < cap ? 1 : 0], cap));
    }
    CHECK(apart > 12);
}

TEST_CASE("bounds of all hits skip the root at the surface where a ray starts", "[hit_bounds]")
{
    // Starts on the side, nearly along it, and leaves it at 2^-49.
    const RayScene<double> drum(scene_of(R"(cylinder {
        z_range = (0, 1.5)  capped = true
        matrix = (-4, 0, 0, -2,
                  0, -8.881784197001252e-16, 3.999999999999999, 2,
                  0, 3.999999999999999, -8.881784197001252e-16, 3) })"));
    const auto all = OneRay<double>({-2, 6, -1}, {-1, 1, 0}).all(drum);
    REQUIRE(all.size() == 1);
    CHECK(holds(all[0], 0x1p-49));
    CHECK(all[0].low > 0x1p-50);
}

TEST_CASE("bounds stay tight along generators, across scales and for long directions",
          "[hit_bounds]")
{
    const RayScene<double> cone(scene_of("cone {}"));
    const HitBounds along = OneRay<double>({0.5, 0, 0.25}, {0, 1, 1}).first(cone);
    CHECK(holds(along, 0.375));
    CHECK(ulps(along) <= 3.0);
    const RayScene<double> needle(
        scene_of("ellipsoid { scale = (0.001, 3, 1)  rotate = (0, 1, 1, 40)  "
                 "translate = (100, 20, 3000) }"));
    for (const double length : {1e-100, 1.0, 1e100}) {
        CAPTURE(length);
        const OneRay<double> ray({0, 0, 0}, length * Vec3(100, 20, 3000));
        const auto both = ray.all(needle);
        REQUIRE(both.size() == 2);
        CHECK(ulps(both[0]) <= 3.0);
        CHECK(both[0].high * length < 1.0);
        CHECK(both[1].low * length > 1.0);
    }
}

TEST_CASE("bounds do not depend on kernel, precision or mode", "[hit_bounds]")
{
    const Scene scene = scene_of(hand_scene);
    const RenderOptions scalar{.kernel = Kernel::scalar};
    const RenderOptions fast{.accuracy = Accuracy::fast};
    const OneRay<float> ray({0.25f, -0.5f, 0}, {0.01f, 0.1f, 1});
    const HitBounds usual = ray.first(RayScene<float>(scene));
    for (const RenderOptions& options : {scalar, fast}) {
        const HitBounds other = ray.first(RayScene<float>(scene, options));
        CHECK(other.low == usual.low);
        CHECK(other.high == usual.high);
    }
}

TEST_CASE("exact arithmetic finds a sphere's surface between its bounds", "[hit_bounds]")
{
    lab::StressRandom random(7);
    int crossings = 0;
    for (int i = 0; i < 300; ++i) {
        Sphere sphere{.center = random.box(random.power(1.0, 1e6)),
                      .radius = random.power(1e-3, 1e3)};
        const Vec3 org = random.box(random.power(1.0, 1e6));
        // Half of the rays aim near the silhouette.
        const Vec3 target = sphere.center + (i % 2 == 0 ? 0.9 : 1.0 - 1e-9) * sphere.radius *
                                                lab::across(random, sphere.center - org);
        Object object{.surface = sphere};
        const RayScene<double> scene(scene_of(object));
        const OneRay<double> ray(org, target - org);
        for (const HitBounds& bounds : ray.all(scene)) {
            CAPTURE(i, bounds.low, bounds.high);
            // Double may find hits that do not exist.
            if (bounds.empty()) {
                CHECK(discriminant_of(sphere, org, target - org) < 0);
                continue;
            }
            CHECK(side_of(sphere, org, target - org, bounds.low) *
                      side_of(sphere, org, target - org, bounds.high) <=
                  0);
            ++crossings;
        }
    }
    CHECK(crossings > 300);
}

TEST_CASE("the check detects bounds that miss the truth", "[hit_bounds]")
{
    // Tests the check itself with hits of another, slightly larger scene.
    const auto& families = lab::stress_families();
    const auto sphere = std::find_if(families.begin(), families.end(),
                                     [](const auto& f) { return f.name == "sphere"; });
    REQUIRE(sphere != families.end());
    lab::StressGroup group = group_of(*sphere, 160, 1);
    const lab::StressSubject subject{"packet", "exact", "auto", true, {}};
    CHECK(lab::check_bounds<double>(subject, group).missed == 0);
    std::get<Sphere>(group.scene.objects[0].surface).radius *= 1.0 + 1e-9;
    CHECK(lab::check_bounds<double>(subject, group).missed > 0);
}

TEST_CASE("bounds of extreme rays contain the truth", "[hit_bounds]")
{
    CHECK(check_families(48, 11) > 2000);
}

TEST_CASE("bounds of a hundred thousand extreme rays contain the truth", "[hit_bounds][slow]")
{
    CHECK(check_families(1500, 12) > 100000);
}

TEST_CASE("intersect prints bounds after the normal", "[hit_bounds]")
{
    const std::string rays = "0,0,0,0,0,1,0,inf\n0,0,0,0,1,0,0,inf\n0,0,0,0,-1,0,0,inf\n";
    for (const std::string precision : {"single", "double"})
        for (const std::string kernel : {"packet", "scalar"}) {
            const ProgramResult result =
                intersect(rays, {"--bounds", "--precision", precision, "--kernel", kernel});
            CHECK(result.exit_code == 0);
            CHECK(result.out ==
                  "hit,t,object,nx,ny,nz,t_low,t_high\n"
                  "1,4,ball,0,0,-1,4,4\n"
                  "0,,,,,,,\n"
                  "1,2,\"floor, tiled\",0,1,0,2,2\n");
        }
    const ProgramResult all = intersect(rays, {"--bounds", "--all"});
    CHECK(all.out ==
          "ray,t,object,nx,ny,nz,t_low,t_high\n"
          "0,4,ball,0,0,-1,4,4\n"
          "0,6,ball,0,0,1,6,6\n"
          "2,2,\"floor, tiled\",0,1,0,2,2\n");
    // A miss has empty bounds: the ray just passes the ball.
    const ProgramResult past =
        intersect("1.00000001,0,0,0,0,1,0,inf\n", {"--bounds", "--precision", "single"});
    CHECK(past.exit_code == 0);
    CHECK(intersect(rays, {"--bounds", "--any"}).exit_code == 2);
}

}  // namespace packtrace::test
