// The bounding ball of a quadric contains its whole surface.
#include "catch.hpp"
#include "geometry/quadric.hpp"
#include "scene_text.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace packtrace::test {
namespace {

LoweredQuadric lowered(const Object& object)
{
    return lower_quadric(object, std::get<Quadric>(object.surface), 0);
}

LoweredQuadric lowered(const std::string& text)
{
    return lowered(parse(text).objects.at(0));
}

/// The largest distance from the ball's centre to the rims and the waist of a surface of revolution
/// x² + y² = r²(z), in radii of the ball.
template <class RadiusAt>
double farthest(const std::string& text, double low, double high, const RadiusAt& radius_at)
{
    const Object object = parse(text).objects.at(0);
    const LoweredQuadric quadric = lowered(object);
    double most = 0.0;
    for (int i = 0; i <= 20; ++i)
        for (int step = 0; step < 360; ++step) {
            const double z = low + (high - low) * i / 20;
            const double angle = 0.0174532925199433 * step;
            const Vec3 own{radius_at(z) * std::cos(angle), radius_at(z) * std::sin(angle), z};
            const Vec3 world(object.transform * glm::dvec4(own, 1.0));
            most = std::max(most, glm::length(world - quadric.bound));
        }
    return most / quadric.bound_radius;
}

}  // namespace

TEST_CASE("the ball around a clipped cylinder is finite, however the cylinder is turned",
          "[quadric_bounds]")
{
    for (const char* turn : {"", "rotate = (1, 0, 0, -90)", "rotate = (0, 1, 0, 152)"}) {
        CAPTURE(turn);
        const auto cylinder = lowered("cylinder { z_range = (-1, 1) scale = (0.5, 0.4, 2) " +
                                      std::string(turn) + " translate = (1, 2, 3) }");
        CHECK(glm::length(cylinder.bound - Vec3(1, 2, 3)) < 1e-12);
        CHECK(cylinder.bound_radius >= std::hypot(2.0, 0.5));
        CHECK(cylinder.bound_radius < 4.0);
    }
}

TEST_CASE("an unbounded surface has no ball", "[quadric_bounds]")
{
    for (const char* open : {"cylinder {}", "cone {}", "hyperboloid { scale = 2 }", "saddle {}"}) {
        CAPTURE(open);
        CHECK(std::isinf(lowered(open).bound_radius));
    }
}

TEST_CASE("the ball around a clipped surface contains it under shears", "[quadric_bounds]")
{
    const std::string shear = "matrix = (1, 0, 1, 0,  0, 1, 0, 0,  0, 0, 1, 0) }";
    const std::string strong = "matrix = (1, 0.5, 7, 0,  0, 1, -3, 0,  0, 0.2, 1, 0) }";
    for (const std::string& matrix : {shear, strong}) {
        CAPTURE(matrix);
        CHECK(farthest("cylinder { z_range = (-1, 1) " + matrix, -1, 1,
                       [](double) { return 1.0; }) <= 1.0);
        CHECK(farthest("cone { z_range = (-0.5, 2) " + matrix, -0.5, 2,
                       [](double z) { return std::abs(z); }) <= 1.0);
        CHECK(farthest("hyperboloid { z_range = (-1, 1.5) " + matrix, -1, 1.5,
                       [](double z) { return std::sqrt(1 + z * z); }) <= 1.0);
    }
}

}  // namespace packtrace::test
