// Directional light along planes, and from points that lie on two surfaces at once.
#include <algorithm>
#include <string>

#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include "catch.hpp"
#include "packet_ways.hpp"

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

}  // namespace

TEST_CASE("What runs along parallel light is not in its way", "[level_light]")
{
    // The light is level: along the floor and the ceiling, which it neither meets nor touches.
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

TEST_CASE("A surface that runs along parallel light to infinity is no shadow of its own",
          "[level_light]")
{
    // The light runs along lines of the cones that these come near to, far away.
    for (const char* surface : {"hyperboloid2 { translate = (0, 0, 0.5)  diffuse = 0.5 }",
                                "hyperboloid { scale = (0.5, 0.5, 0.5)  diffuse = 0.5 }"})
        for (const char* light : {"(0, 1, -1)", "(0, -1, -1)", "(1, 0, -1)", "(-1, 0, -1)"}) {
            CAPTURE(surface, light);
            check_all_packets(lit_wall(light, surface));
        }
}

TEST_CASE("What a lit point lies on exactly is not in its way", "[level_light]")
{
    // The middle column of pixels is at x = 0, in the plane across it.
    for (const char* light : {"(1, 0.5, -1)", "(-1, 0.5, -1)"})
        for (const char* normal : {"(1, 0, 0)", "(-1, 0, 0)"}) {
            CAPTURE(light, normal);
            const std::string across =
                std::string("plane { point = (0, 0, 0)  normal = ") + normal + "  diffuse = 0.5 }";
            check_all_packets(lit_wall(light, across));
        }
}

TEST_CASE("Glass along parallel light passes all of it on", "[level_light]")
{
    for (const char* normal : {"(0, 1, 0)", "(0, -1, 0)"}) {
        CAPTURE(normal);
        check_all_packets(
            lit_wall("(1, 0, -1)", std::string("shadows = transparent\n"
                                               "plane { point = (0, -4, 0)  normal = ") +
                                       normal + "  diffuse = 0.5  transmit = 0.5 }"));
    }
}

}  // namespace packtrace::test
