// Directional light parallel to planes and caps. Also light at points whose side of a surface
// rounding hides: on two surfaces at once, or at the world's origin.
#include "catch.hpp"
#include "packet_ways.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <string>

namespace packtrace::test {
namespace {

/// A wall across the view, lit from the side, and `more`.
Scene lit_wall(const std::string& light, const std::string& more)
{
    return parse_scene(R"(
        illumination = general
        image_size = 9 x 7
        camera { position = (0, 0, -5)  look_at = (0, 0, 0)  fov = 40 }
        plane { point = (0, 0, 2)  normal = (0, 0, -1)  diffuse = 0.8 }
        light { type = directional  intensity = 1  direction = )" +
                           light + " }\n" + more,
                       "wall", {});
}

double largest(const Image<double>& image)
{
    double most = 0.0;
    for (const double value : image.rgb)
        most = std::max(most, value);
    return most;
}

void check_all_packets(const Scene& scene)
{
    const Image<double> expected = render<double>(scene, {.kernel = Kernel::scalar});
    REQUIRE(largest(expected) > 0.1);
    for (const Accuracy accuracy : {Accuracy::exact, Accuracy::fast})
        for (const RenderOptions& options : packet_ways(accuracy)) {
            INFO(options.isa);
            CHECK(largest_difference(render<float>(scene, options), expected) < 1e-5);
            if (accuracy == Accuracy::exact)
                CHECK(largest_difference(render<double>(scene, options), expected) < 1e-5);
        }
}

std::string vector_text(double x, double y, double z)
{
    std::ostringstream text;
    text.precision(17);
    text << '(' << x << ", " << y << ", " << z << ')';
    return text.str();
}

/// The cap of a cylinder turned about y fills the view; the light runs along the cap. All pixels
/// see the light's highlight, or none does.
Scene lit_cap(const std::string& illumination, const std::string& material, int degrees)
{
    const double angle = degrees * std::numbers::pi / 180.0;
    const double sine = std::sin(angle);
    const double cosine = std::cos(angle);
    return parse_scene("illumination = " + illumination +
                           "\nimage_size = 12 x 12\ncamera { fov = 20  look_at = " +
                           vector_text(6.0 * sine, 0.6, 6.0 * cosine) + "  position = " +
                           vector_text(9.0 * sine - 2.0 * cosine, 0.0, 9.0 * cosine + 2.0 * sine) +
                           " }\ncylinder { z_range = (-2, 2)  capped = yes  " + material +
                           "  rotate = (0, 1, 0, " + std::to_string(degrees) +
                           ")  scale = 3 }\nlight { type = directional  intensity = 1  "
                           "direction = " +
                           vector_text(cosine, 0.3, -sine) + " }",
                       "cap", {});
}

template <class Real>
void check_lit_alike(const Image<Real>& image)
{
    std::size_t lit = 0;
    for (const Real value : image.rgb)
        lit += value > Real(0.01) ? 1 : 0;
    CHECK((lit == 0 || lit == image.rgb.size()));
}

}  // namespace

TEST_CASE("A surface along parallel light does not occlude it", "[level_light]")
{
    // The light is horizontal: it runs along the floor and the ceiling and neither hits nor touches
    // them.
    for (const char* light : {"(1, 0, -1)", "(-1, 0, -1)"})
        for (const char* normal : {"(0, 1, 0)", "(0, -1, 0)"})
            for (const char* height : {"-4", "4"}) {
                CAPTURE(light, normal, height);
                const std::string plane = std::string("plane { point = (0, ") + height +
                                          ", 0)  normal = " + normal + "  diffuse = 0.5 }";
                check_all_packets(lit_wall(light, plane));
            }
    const char* const others[] = {
        "polygon { vertices = (-9, -4, -9), (9, -4, -9), (9, -4, 9), (-9, -4, 9)  diffuse = 0.5 }",
        "polygon { vertices = (-9, 4, 9), (9, 4, 9), (9, 4, -9), (-9, 4, -9)  diffuse = 0.5 }",
        "quadric { coefficients = (0, 0, 0, 0, 0, 0, 0, 1, 0, 4)  diffuse = 0.5 }",
        "quadric { coefficients = (0, 0, 0, 0, 0, 0, 0, -1, 0, 4)  diffuse = 0.5 }",
        "quadric { coefficients = (0, 1, 0, 0, 0, 0, 0, 0, 0, -16)  diffuse = 0.5 }",
    };
    for (const char* other : others) {
        CAPTURE(other);
        check_all_packets(lit_wall("(1, 0, -1)", other));
        check_all_packets(lit_wall("(-1, 0, -1)", other));
    }
}

TEST_CASE("A surface that extends along parallel light to infinity does not shadow itself",
          "[level_light]")
{
    // The light runs along lines of the cones that these surfaces approach far away.
    for (const char* surface : {"hyperboloid2 { translate = (0, 0, 0.5)  diffuse = 0.5 }",
                                "hyperboloid { scale = (0.5, 0.5, 0.5)  diffuse = 0.5 }"})
        for (const char* light : {"(0, 1, -1)", "(0, -1, -1)", "(1, 0, -1)", "(-1, 0, -1)"}) {
            CAPTURE(surface, light);
            check_all_packets(lit_wall(light, surface));
        }
}

TEST_CASE("A surface through a lit point does not occlude the light", "[level_light]")
{
    // The middle column of pixels is at x = 0, in the plane across the wall.
    for (const char* light : {"(1, 0.5, -1)", "(-1, 0.5, -1)"})
        for (const char* normal : {"(1, 0, 0)", "(-1, 0, 0)"}) {
            CAPTURE(light, normal);
            const std::string across =
                std::string("plane { point = (0, 0, 0)  normal = ") + normal + "  diffuse = 0.5 }";
            check_all_packets(lit_wall(light, across));
        }
}

TEST_CASE("Glass along parallel light passes all of the light", "[level_light]")
{
    for (const char* normal : {"(0, 1, 0)", "(0, -1, 0)"}) {
        CAPTURE(normal);
        check_all_packets(
            lit_wall("(1, 0, -1)", std::string("shadows = transparent\n"
                                               "plane { point = (0, -4, 0)  normal = ") +
                                       normal + "  diffuse = 0.5  transmit = 0.5 }"));
    }
}

TEST_CASE("Light along a cap lights all of it or none of it", "[level_light]")
{
    for (const int degrees : {10, 20, 30, 45, 60})
        for (const bool scratch : {false, true}) {
            CAPTURE(degrees, scratch);
            const Scene scene = scratch
                                    ? lit_cap("scratch", "specular = 2", degrees)
                                    : lit_cap("general", "highlight = 1  shininess = 2", degrees);
            for (const Accuracy accuracy : {Accuracy::exact, Accuracy::fast})
                for (const RenderOptions& options : packet_ways(accuracy)) {
                    INFO(options.isa);
                    check_lit_alike(render<float>(scene, options));
                    if (accuracy == Accuracy::exact)
                        check_lit_alike(render<double>(scene, options));
                }
        }
}

TEST_CASE("A body seen from inside at the world's origin occludes light from behind",
          "[level_light]")
{
    for (const char* light :
         {"type = point  position = (0, 0, 5)", "type = directional  direction = (0, 0, 1)"}) {
        CAPTURE(light);
        const Scene scene = parse_scene(std::string(R"(
                illumination = general
                image_size = 1 x 1
                camera { position = (0, 0, 1)  look_at = (0, 0, 0) }
                sphere { center = (0, 0, 1)  radius = 1  diffuse = 1 }
                light { intensity = 1  )") + light +
                                            " }",
                                        "inside", {});
        CHECK(largest(render<double>(scene, {.kernel = Kernel::scalar})) == 0.0);
        for (const Accuracy accuracy : {Accuracy::exact, Accuracy::fast})
            for (const RenderOptions& options : packet_ways(accuracy)) {
                INFO(options.isa);
                CHECK(render<float>(scene, options).rgb[0] == 0.0F);
                CHECK(largest(render<double>(scene, options)) == 0.0);
            }
    }
}

}  // namespace packtrace::test
