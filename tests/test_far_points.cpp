// Shadows at points so far away that a light and its neighbours nearly coincide.
#include "catch.hpp"
#include "packet_ways.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <algorithm>

namespace packtrace::test {
namespace {

template <class Real>
std::ptrdiff_t black_pixels(const Image<Real>& image)
{
    std::ptrdiff_t black = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
        black += image.rgb[i] == 0 && image.rgb[i + 1] == 0 && image.rgb[i + 2] == 0;
    return black;
}

}  // namespace

TEST_CASE("a small ball far away casts no shadow larger than its own", "[far_points]")
{
    // The shadow is too small to contain the centre of a pixel.
    const Scene scene = parse_scene(R"(
image_size = 64 x 48
background = (9, 9, 9)
camera { position = (0, 3e6, -1e7) look_at = (0, 0, 0) fov = 60 }
sphere { center = (0.013, 0.1, 0.021) radius = 1e-6 }
plane { point = (0, 0, 0) normal = (0, 1, 0) color = (255, 255, 255) }
light { type = point intensity = 1 position = (0.0531, 0.2173, 0.0117) }
)",
                                    "far points", {});
    for (const Accuracy accuracy : {Accuracy::exact, Accuracy::fast})
        for (const RenderOptions& options : packet_ways(accuracy)) {
            CAPTURE(options.isa, options.traversal == Traversal::tree);
            CHECK(black_pixels(render<float>(scene, options)) == 0);
            CHECK(black_pixels(render<double>(scene, options)) == 0);
        }
}

TEST_CASE("a ball around a light keeps everything dark, however far away", "[far_points]")
{
    const Scene scene = parse_scene(R"(
image_size = 32 x 24
background = (9, 9, 9)
camera { position = (0, 3e6, -1e7) look_at = (0, 0, 0) fov = 60 }
sphere { center = (0.013, 1.1, 0.021) radius = 0.9 }
plane { point = (0, 0, 0) normal = (0, 1, 0) color = (255, 255, 255) }
light { type = point intensity = 1 position = (0.0531, 1.2173, 0.0117) }
)",
                                    "dark", {});
    for (const RenderOptions& options : packet_ways()) {
        CAPTURE(options.isa, options.traversal == Traversal::tree);
        const Image<float> image = render<float>(scene, options);
        const std::ptrdiff_t sky = std::count(image.rgb.begin(), image.rgb.end(), image.rgb[0]) / 3;
        CHECK(sky > 0);
        CHECK(black_pixels(image) == 32 * 24 - sky);
    }
}

}  // namespace packtrace::test
