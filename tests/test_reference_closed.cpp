// Closed bodies are closed in the scalar reference: rays leave them as often as they enter them, at
// rims too.
#include "catch.hpp"
#include "reference/ray.hpp"
#include "reference/surfaces/hits.hpp"
#include "reference_scenes.hpp"

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

using V = reference::Vec3<double>;

template <class Real>
constexpr Real unbounded = reference::infinity<Real>;

using Coefficients = std::array<double, 10>;

/// A capped kind of quadric; `radius` gives the radius of its circle at height z.
struct CappedKind {
    std::string name;
    Coefficients coefficients;
    double low;
    double high;
    std::function<double(double)> radius;
};

const std::vector<CappedKind>& capped_kinds()
{
    static const std::vector<CappedKind> kinds = {
        {"ellipsoid",
         {1, 1, 1, 0, 0, 0, 0, 0, 0, -1},
         -0.6,
         0.8,
         [](double z) { return std::sqrt(1 - z * z); }},
        {"cylinder", {1, 1, 0, 0, 0, 0, 0, 0, 0, -1}, -1, 1, [](double) { return 1.0; }},
        {"cone", {1, 1, -1, 0, 0, 0, 0, 0, 0, 0}, -1, 2, [](double z) { return std::abs(z); }},
        {"paraboloid",
         {1, 1, 0, 0, 0, 0, 0, 0, -1, 0},
         0.25,
         2,
         [](double z) { return std::sqrt(z); }},
        {"hyperboloid",
         {1, 1, -1, 0, 0, 0, 0, 0, 0, -1},
         -1,
         1.5,
         [](double z) { return std::sqrt(1 + z * z); }},
        {"hyperboloid2", {1, 1, -1, 0, 0, 0, 0, 0, 0, 1}, -3, 2.5, [](double z) {
             return std::sqrt(z * z - 1);
         }}};
    return kinds;
}

Object capped(const CappedKind& kind)
{
    Object object = quadric(kind.coefficients);
    auto& surface = std::get<Quadric>(object.surface);
    surface.z_range = ZRange{kind.low, kind.high};
    surface.capped = true;
    return object;
}

/// Rays from inside a capped body in object space, half of them aimed at its rims.
class RaysInside {
public:
    explicit RaysInside(const CappedKind& kind) : kind_(kind)
    {
    }
    template <class Real>
    void next(reference::Vec3<Real>& org, reference::Vec3<Real>& dir)
    {
        org = reference::Vec3<Real>(inside());
        aimed_ = !aimed_;
        dir = aimed_ ? reference::Vec3<Real>(at_rim()) - org : reference::Vec3<Real>(anywhere());
    }

private:
    double uniform(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    Vec3 circle(double radius, double z)
    {
        const double angle = uniform(0, 6.283185307179586);
        return {radius * std::cos(angle), radius * std::sin(angle), z};
    }
    Vec3 inside()
    {
        for (;;) {
            const double z = uniform(kind_.low + 0.05, kind_.high - 0.05);
            const double radius = kind_.radius(z) - 0.05;
            if (radius > 0)
                return circle(radius * uniform(0, 1), z);
        }
    }
    Vec3 at_rim()
    {
        const double z = uniform(0, 1) < 0.5 ? kind_.low : kind_.high;
        return circle(kind_.radius(z), z);
    }
    Vec3 anywhere()
    {
        return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    }

    const CappedKind& kind_;
    std::mt19937 random_{7};
    bool aimed_ = false;
};

Mat4 turned_and_sheared()
{
    Mat4 matrix(1.0);
    matrix[0] = {0.36, 0.48, -0.8, 0};
    matrix[1] = {-0.8, 0.6, 0, 0};
    matrix[2] = {0.7, 0.64, 0.6, 0};
    matrix[3] = {3, -2, 5, 1};
    return matrix;
}

template <class Real>
std::vector<reference::SurfaceHit<Real>> hits_ahead(const reference::Bodies<Real>& bodies,
                                                    const reference::Vec3<Real>& org,
                                                    const reference::Vec3<Real>& dir)
{
    return reference::all_hits(bodies, org, dir, Real(0), unbounded<Real>);
}

/// Whether hits alternate between leaving and entering, beginning and ending with leaving.
template <class Real>
bool ends_outside(const std::vector<reference::SurfaceHit<Real>>& hits)
{
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].leaving != (i % 2 == 0))
            return false;
    return hits.size() % 2 == 1;
}

template <class Real>
bool is_unit(const reference::Vec3<Real>& v)
{
    return std::abs(reference::dot(v, v) - 1) < 1e-5;
}

}  // namespace

TEMPLATE_TEST_CASE("every ray from inside a capped body leaves it once more than it enters it",
                   "[reference_closed]", float, double, long double)
{
    for (const CappedKind& kind : capped_kinds())
        for (const bool moved : {false, true}) {
            CAPTURE(kind.name, moved);
            Scene scene{.objects = {capped(kind)}};
            if (moved)
                scene.objects[0].transform = turned_and_sheared();
            const reference::Affine<TestType> placement(scene.objects[0].transform);
            const reference::Bodies<TestType> bodies(scene);
            RaysInside rays(kind);
            int lost = 0;
            for (int i = 0; i < 100'000; ++i) {
                reference::Vec3<TestType> org, dir;
                rays.next(org, dir);
                lost += !ends_outside(hits_ahead(bodies, placement.point_to_world(org),
                                                 placement.vector_to_world(dir)));
            }
            CHECK(lost == 0);
        }
}

TEMPLATE_TEST_CASE("a mirrored ray inside a capped body stays in it, at rims too",
                   "[reference_closed]", float, double, long double)
{
    using Vec = reference::Vec3<TestType>;
    for (const CappedKind& kind : capped_kinds()) {
        CAPTURE(kind.name);
        Scene scene{.objects = {capped(kind)}};
        scene.objects[0].transform = turned_and_sheared();
        const reference::World<TestType> world(scene, SelfHits::exact);
        const reference::Affine<TestType> placement(scene.objects[0].transform);
        RaysInside rays(kind);
        int lost = 0;
        int entered_again = 0;
        for (int i = 0; i < 2'000; ++i) {
            Vec org, dir;
            rays.next(org, dir);
            dir = placement.vector_to_world(dir);
            org = placement.point_to_world(org);
            reference::Start<TestType> start{org, org, TestType(0)};
            for (int bounce = 0; bounce < 10; ++bounce) {
                const auto at = closest_surface(world, start, dir, unbounded<TestType>);
                if (!at || !at->leaving || !is_unit(at->N)) {
                    ++lost;
                    break;
                }
                // A ray that continues outside hits the body again only where it enters.
                const auto beyond = closest_surface(world, start_at(world, at->through(), at->P),
                                                    dir, unbounded<TestType>);
                entered_again += beyond && beyond->leaving;
                dir = reference::reflect_ray(-dir, at->N);
                start = start_at(world, at->back(), at->P);
            }
        }
        CHECK(lost == 0);
        CHECK(entered_again == 0);
    }
}

TEST_CASE("the side and a cap of a cylinder share their edge", "[reference_closed]")
{
    Scene scene{.objects = {capped(capped_kinds()[1])}};
    const reference::Bodies<double> bodies(scene);
    const auto slanted = hits_ahead(bodies, V(0.5, -0.10000000149011612, -0.30000001192092896),
                                    V(0.5, 0.10000000149011612, -0.699999988079071));
    REQUIRE(slanted.size() == 1);
    CHECK(slanted[0].t == Approx(1.0));
    // Into the edge of the lid and out of the bottom; from the lid into the edge of the bottom.
    const auto from_edge = hits_ahead(bodies, V(2, 0, 2), V(-1, 0, -1));
    REQUIRE(from_edge.size() == 2);
    CHECK(from_edge[0].normal == V(1, 0, 0));
    CHECK(from_edge[1].normal == V(-1, 0, 0));
    const auto into_edge = hits_ahead(bodies, V(-0.5, 0, 2), V(0.5, 0, -1));
    REQUIRE(into_edge.size() == 2);
    CHECK(into_edge[0].normal == V(0, 0, 1));
    CHECK(into_edge[1].normal == V(1, 0, 0));
    // A ray that touches the edge hits it twice.
    const auto touching = hits_ahead(bodies, V(-2, 0, 0), V(1, 0, 1));
    REQUIRE(touching.size() == 2);
    CHECK(touching[0].t == 1.0);
    CHECK(touching[1].t == 1.0);
    CHECK(touching[0].leaving == false);
    CHECK(touching[1].leaving == true);
}

TEST_CASE("a clipped surface without caps has its edges", "[reference_closed]")
{
    Scene scene{.objects = {capped(capped_kinds()[1])}};
    std::get<Quadric>(scene.objects[0].surface).capped = false;
    const reference::Bodies<double> bodies(scene);
    CHECK(hits_ahead(bodies, V(2, 0, 2), V(-1, 0, -1)).size() == 2);
    CHECK(hits_ahead(bodies, V(-2, 0, 0), V(1, 0, 1)).size() == 1);
    CHECK(hits_ahead(bodies, V(-2, 0, 1), V(1, 0, 0)).size() == 2);
    CHECK(hits_ahead(bodies, V(-2, 0, 1.0000000000000002), V(1, 0, 0)).empty());
}

}  // namespace packtrace::test
