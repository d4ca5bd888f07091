// Rays along asymptotes and generators of quadrics. Here a in a t² + 2 b t + c = 0 is 0 and b may
// be small: the hit is at t = -c / 2b, however far.
#include "catch.hpp"
#include "core/quad.hpp"
#include "packet_ways.hpp"
#include "scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

/// A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + I z + J = 0.
struct Equation {
    std::string text;
    std::array<double, 10> coefficients;
    bool is_turned = false;
};

const Equation cone{"cone { }", {1, 1, -1, 0, 0, 0, 0, 0, 0, 0}};
const Equation one_sheet{"hyperboloid { }", {1, 1, -1, 0, 0, 0, 0, 0, 0, -1}};
const Equation two_sheets{"hyperboloid2 { }", {1, 1, -1, 0, 0, 0, 0, 0, 0, 1}};
const Equation saddle{"saddle { }", {1, -1, 0, 0, 0, 0, 0, 0, -1, 0}};
const Equation hyperbolic_cylinder{"quadric { coefficients = (1, -1, 0, 0, 0, 0, 0, 0, 0, -1) }",
                                   {1, -1, 0, 0, 0, 0, 0, 0, 0, -1}};
const Equation crossing{"quadric { coefficients = (1, -1, 0, 0, 0, 0, 0, 0, 0, 0) }",
                        {1, -1, 0, 0, 0, 0, 0, 0, 0, 0}};
const Equation turned_saddle{"quadric { coefficients = (0, 0, 0, 1, 0, 0, 0, 0, -1, 0) }",
                             {0, 0, 0, 1, 0, 0, 0, 0, -1, 0},
                             true};
const Equation turned_cone{"quadric { coefficients = (0, 0, -0.7, 1.3, 0, 0.4, 0, 0, 0, 0) }",
                           {0, 0, -0.7, 1.3, 0, 0.4, 0, 0, 0, 0},
                           true};

using Triple = std::array<double, 3>;

/// A sum, and the sum of the magnitudes of its terms.
struct Sum {
    Quad value = 0;
    double size = 0;

    void add(Quad term)
    {
        value += term;
        size += std::abs(static_cast<double>(term));
    }
};

/// The coefficients a, b and c of a t² + 2 b t + c along a ray.
std::array<Sum, 3> along(const Equation& equation, const Triple& org, const Triple& dir)
{
    const auto& k = equation.coefficients;
    std::array<Sum, 3> abc;
    const auto product = [&](double coefficient, std::size_t i, std::size_t j) {
        const Quad q = coefficient;
        abc[0].add(q * dir[i] * dir[j]);
        abc[1].add(q * org[i] * dir[j] / 2);
        abc[1].add(q * org[j] * dir[i] / 2);
        abc[2].add(q * org[i] * org[j]);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        product(k[i], i, i);
        abc[1].add(Quad(k[6 + i]) * dir[i] / 2);
        abc[2].add(Quad(k[6 + i]) * org[i]);
    }
    product(k[3], 0, 1);
    product(k[4], 0, 2);
    product(k[5], 1, 2);
    abc[2].add(k[9]);
    return abc;
}

/// The hit of a ray with a = 0, and the relative error that double may have there.
struct OneHit {
    double t;
    double rounding;
};

double largest_of(const Triple& v)
{
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

OneHit only_hit(const Equation& equation, const Triple& org, const Triple& dir)
{
    auto [a, b, c] = along(equation, org, dir);
    REQUIRE(std::abs(static_cast<double>(a.value)) <= 0x1p-52 * a.size);
    // The coefficients of turned axes are rounded, even those that would be 0.
    if (equation.is_turned) {
        b.size += 2 * largest_of(org) * largest_of(dir);
        c.size += 2 * largest_of(org) * largest_of(org);
    }
    const double t = static_cast<double>(-c.value / (2 * b.value));
    return {t, 0x1p-49 * (b.size / std::abs(static_cast<double>(b.value)) +
                          c.size / std::abs(static_cast<double>(c.value)))};
}

template <class Real>
void check_hit(const RayScene<Real>& scene, const OneHit& hit, const Triple& org, const Triple& dir)
{
    const auto real = [](double x) { return static_cast<Real>(x); };
    Ray<Real> ray{{real(org[0]), real(org[1]), real(org[2])},
                  {real(dir[0]), real(dir[1]), real(dir[2])}};
    CAPTURE(sizeof(Real), org[0], org[1], org[2], dir[0], dir[1], dir[2], hit.t);
    const double allowed = hit.rounding + std::numeric_limits<Real>::epsilon();
    const SurfaceHit<Real> first = scene.closest_hit(ray);
    REQUIRE(first.object == 0);
    CHECK(std::abs(static_cast<double>(first.t) - hit.t) <= allowed * hit.t);
    const std::vector<SurfaceHit<Real>> all = scene.all_hits(ray);
    REQUIRE(all.size() == 1);
    CHECK(std::abs(static_cast<double>(all[0].t) - hit.t) <= allowed * hit.t);
    ray.t_max = static_cast<Real>(hit.t * (1.0 + 2.0 * allowed));
    CHECK(scene.occluded(ray));
    ray.t_max = static_cast<Real>(hit.t * (1.0 - 2.0 * allowed));
    CHECK_FALSE(scene.occluded(ray));
    CHECK(scene.closest_hit(ray).object == -1);
}

struct AsymptoticRay {
    const Equation& surface;
    Triple org, dir;
};

/// Rounded to single precision, so that float and double trace the same ray.
double rounded(double x)
{
    return static_cast<double>(static_cast<float>(x));
}

/// Rays with directions that make a zero. Their directions are 10^-2 to 10^-7 off those that make b
/// zero too.
std::vector<AsymptoticRay> random_rays(const Equation& surface, const std::vector<Triple>& ways)
{
    SceneRandom random(11);
    std::vector<AsymptoticRay> rays;
    const auto& k = surface.coefficients;
    while (rays.size() < 300) {
        const Triple& dir = ways[static_cast<std::size_t>(random.between(0, double(ways.size())))];
        Triple org{random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
        const double off = std::pow(10.0, random.between(-7, -2));
        const std::size_t axis = k[2] != 0 ? 2 : 1;
        org[axis] = 0;
        const Sum slope = along(surface, org, dir)[1];
        org[axis] = off - static_cast<double>(slope.value) / (k[axis] * dir[axis]);
        for (double& x : org)
            x = rounded(x);
        const auto [a, b, c] = along(surface, org, dir);
        if (b.value * c.value >= 0 || std::abs(double(c.value)) < 1e-3 * c.size)
            continue;
        rays.push_back({surface, org, dir});
    }
    return rays;
}

void check_rays(const std::vector<AsymptoticRay>& rays)
{
    for (const RenderOptions& options : packet_ways()) {
        if (options.traversal == Traversal::tree)
            continue;
        INFO(options.isa);
        const Scene scene = parse_scene(rays[0].surface.text, "surface", {});
        const RayScene<float> singles(scene, options);
        const RayScene<double> doubles(scene, options);
        for (const AsymptoticRay& ray : rays) {
            const OneHit hit = only_hit(ray.surface, ray.org, ray.dir);
            check_hit(singles, hit, ray.org, ray.dir);
            check_hit(doubles, hit, ray.org, ray.dir);
        }
    }
}

}  // namespace

TEST_CASE("rays along asymptotes hit where their equations say", "[asymptotes]")
{
    const std::vector<Triple> cones{{1, 0, 1}, {0, 1, 1}, {3, 4, 5}, {5, 12, 13}, {-3, 4, 5}};
    const std::vector<Triple> flat{{1, 1, 0}, {1, -1, 0}};
    for (const Equation* surface : {&cone, &one_sheet, &two_sheets})
        check_rays(random_rays(*surface, cones));
    for (const Equation* surface : {&saddle, &hyperbolic_cylinder})
        check_rays(random_rays(*surface, flat));
}

TEST_CASE("rays next to asymptotes that earlier versions lost or misplaced hit where they should",
          "[asymptotes]")
{
    const double far_x = rounded(-0.9917580485343933);
    const double near_x = rounded(0.44015663862228394);
    const std::vector<AsymptoticRay> rays{
        {cone, {0, 1, rounded(1e-6)}, {1, 0, 1}},
        {cone, {far_x, rounded(-0.11272796988487244), rounded(-0.5661755204200745)}, {8, 15, 17}},
        {cone, {0, 1, rounded(0.800001)}, {3, 4, 5}},
        {cone, {near_x, rounded(-0.5735037326812744), rounded(-0.722896933555603)}, {-3, 4, 5}},
        {one_sheet, {0, 2, rounded(1e-8)}, {1, 0, 1}},
        {saddle, {0, rounded(-1e-6), 1}, {1, 1, 0}},
        {saddle, {0, rounded(-1e-8), 1}, {1, 1, 0}},
        {hyperbolic_cylinder, {rounded(1e-8), 0, 0}, {1, 1, 0}},
        {crossing, {0, rounded(-1e-8), -1}, {1, 1, 1}},
        {turned_saddle, {0, rounded(1e-7), 1}, {1, 0, 0}},
        {turned_cone, {rounded(0.7), rounded(-1e-7), 3}, {-1, 0, 0}}};
    for (const AsymptoticRay& ray : rays)
        check_rays({ray});
}

TEST_CASE("a wall just behind a cone's distant hit does not hide the cone", "[asymptotes]")
{
    const Scene scene =
        parse_scene("cone { }\nplane { point = (500001, 0, 0)  normal = (1, 0, 0) }\n", "wall", {});
    for (const RenderOptions& options : packet_ways()) {
        INFO(options.isa);
        const float height = 1e-6f;
        CHECK(RayScene<float>(scene, options).closest_hit({{0, 1, height}, {1, 0, 1}}).object == 0);
        CHECK(RayScene<double>(scene, options)
                  .closest_hit({{0, 1, double{height}}, {1, 0, 1}})
                  .object == 0);
    }
}

}  // namespace packtrace::test
