// Pictures of the packet kernels against those of the scalar reference.
#include "catch.hpp"
#include "packet_scenes.hpp"
#include "render_scene.hpp"
#include <packtrace/compare.hpp>

namespace packtrace::test {
namespace {

/// Checks note 001 in floats against the exact picture, with the bounds.
void check_float_error(int size)
{
    const Scene scene = four_spheres(size, size);
    const Image<double> exact = render_scalar<double>(scene);
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa, size);
        const auto picture = convert<double>(render_packets<float>(scene, isa));
        const Comparison error = compare(picture, exact);
        CHECK(error.rmse <= 2e-4);
        CHECK(static_cast<double>(error.pixels_off) < 0.0005 * static_cast<double>(error.pixels));
    }
}

FrameCounts count_rays(const Scene& scene, const std::string& isa)
{
    const RenderOptions options{.isa = isa};
    Image<float> image;
    return Renderer<float>(scene, options).render(image);
}

}  // namespace

TEST_CASE("packets of doubles give the double reference's picture, on every pixel", "[packets]")
{
    for (const NamedScene& named : packet_scenes()) {
        const Image<double> expected = render_scalar<double>(named.scene);
        for (const std::string& isa : supported_isas()) {
            CAPTURE(named.name, isa);
            const Comparison error = compare(render_packets<double>(named.scene, isa), expected);
            CHECK(error.max_abs <= 1e-9);
        }
    }
}

TEST_CASE("packets of doubles give the double reference's picture of note 001 in full size",
          "[packets][slow]")
{
    const Scene scene = four_spheres(1024, 1024);
    const Image<double> expected = render_scalar<double>(scene);
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        CHECK(compare(render_packets<double>(scene, isa), expected).max_abs <= 1e-9);
    }
}

TEST_CASE("packets of floats stay within note 001's error bounds", "[packets]")
{
    // No canvas point of this size touches a sphere exactly, as (-0.4, 0.1) does.
    check_float_error(251);
}

TEST_CASE("packets of floats stay within note 001's error bounds in full size", "[packets][slow]")
{
    check_float_error(1024);
}

TEST_CASE("packets of floats are as close to the truth as the scalar reference in floats",
          "[packets]")
{
    for (const NamedScene& named : packet_scenes()) {
        const Image<double> exact = render_scalar<double>(named.scene);
        const auto scalar = convert<double>(render_scalar<float>(named.scene));
        // Rounding may decide a pixel at a silhouette either way.
        const std::size_t bound = compare(scalar, exact).pixels_off + 3;
        for (const std::string& isa : supported_isas()) {
            CAPTURE(named.name, isa);
            const auto picture = convert<double>(render_packets<float>(named.scene, isa));
            CHECK(compare(picture, exact).pixels_off <= bound);
        }
    }
}

TEST_CASE("a scene without objects is its background", "[packets]")
{
    Scene scene;
    set_size(scene, 37, 21);
    scene.background = {0.25, 0.5, 0.75};
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const Image<float> picture = render_packets<float>(scene, isa);
        int wrong = 0;
        for (int y = 0; y < scene.height; ++y)
            for (int x = 0; x < scene.width; ++x) {
                const float* pixel = picture.pixel(x, y);
                wrong += pixel[0] != 0.25f || pixel[1] != 0.5f || pixel[2] != 0.75f;
            }
        CHECK(wrong == 0);
    }
}

TEST_CASE("rays are counted by kind, the same for every width", "[packets]")
{
    for (const NamedScene& named : packet_scenes()) {
        std::vector<std::string> isas = fused_isas();
        if (isas.empty())
            isas = supported_isas();
        const FrameCounts first = count_rays(named.scene, isas.front());
        for (const std::string& isa : isas) {
            CAPTURE(named.name, isa);
            const FrameCounts counts = count_rays(named.scene, isa);
            CHECK(counts.camera ==
                  static_cast<std::uint64_t>(named.scene.width * named.scene.height));
            CHECK(counts.shadow == first.shadow);
            CHECK(counts.reflected == first.reflected);
        }
    }
}

TEST_CASE("without shadows there are no shadow rays, and at depth 0 no mirrored rays", "[packets]")
{
    Scene scene = four_spheres(37, 21);
    CHECK(count_rays(scene, "auto").shadow > 0);
    CHECK(count_rays(scene, "auto").reflected > 0);
    scene.shadows = ShadowKind::none;
    CHECK(count_rays(scene, "auto").shadow == 0);
    scene.max_depth = 0;
    CHECK(count_rays(scene, "auto").reflected == 0);
}

}  // namespace packtrace::test
