// Paths traced in registers give the same colours as paths in streams, bit for bit.
#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "few_objects.hpp"
#include "lower/packed_scene.hpp"
#include "lower/prune.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include <packtrace/build.hpp>
#include <packtrace/read_scene.hpp>

namespace packtrace::test {
namespace {

bool in_registers(const Scene& scene, const std::string& isa)
{
    LoweredScene lowered = lower(scene);
    prune(lowered);
    const auto& table = precision<float>(kernels_of(isa));
    const PackedScene<float> packed(lowered,
                                    frame_traversal(lowered, Traversal::automatic, table.lanes));
    return fused_for(table, lowered.features, packed.view()) != nullptr;
}

struct Frame {
    Image<float> image;
    abi::RayCounts counts;
};

/// Renders in tiles, as frames are; with `streams`, in streams of the general kernel.
Frame render_tiles(const Scene& scene, const std::string& isa, bool streams, int samples = 1)
{
    const RenderOptions options{.force_general = streams, .samples = samples};
    const TileRenderer<float> tiles(scene, lower(scene), kernels_of(isa), options);
    Frame frame{Image<float>(scene.width, scene.height), {}};
    const TileGrid grid({0, 0, scene.width, scene.height});
    for (int tile = 0; tile < grid.count(); ++tile)
        frame.counts += tiles.render(frame.image, grid[tile]);
    return frame;
}

Scene note_scene()
{
    return read_scene(std::string(PACKTRACE_SOURCE_DIR) + "/scenes/four_spheres.scene");
}

}  // namespace

TEST_CASE("paths in registers give the same bits as streams", "[fused]")
{
    unsigned traced = 0;
    for (unsigned seed = 1; seed <= scene_count(150); ++seed) {
        const Scene scene = FewObjects(seed).scene;
        for (const std::string& isa : supported_isas()) {
            traced += in_registers(scene, isa);
            CAPTURE(seed, isa);
            CHECK(same_bits(render_tiles(scene, isa, false).image,
                            render_tiles(scene, isa, true).image));
        }
    }
    CHECK(traced >= scene_count(150) * supported_isas().size() / 2);
}

TEST_CASE("paths in registers trace the same rays as streams", "[fused]")
{
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const abi::RayCounts streams = render_tiles(note_scene(), isa, true).counts;
        const abi::RayCounts registers = render_tiles(note_scene(), isa, false).counts;
        CHECK(registers.camera == streams.camera);
        CHECK(registers.shadow == streams.shadow);
        CHECK(registers.reflected == streams.reflected);
        CHECK(registers.refracted == streams.refracted);
    }
}

TEST_CASE("pictures with several samples a pixel are traced in registers too", "[fused]")
{
    Scene scene = note_scene();
    set_size(scene, 70, 45);
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        CHECK(same_bits(render_tiles(scene, isa, false, 4).image,
                        render_tiles(scene, isa, true, 4).image));
    }
    RenderOptions options{.samples = 8, .adaptive = 0.05};
    const Image<float> registers = render<float>(scene, options);
    options.force_general = true;
    CHECK(same_bits(registers, render<float>(scene, options)));
}

TEST_CASE("scenes that registers have no room for are traced in streams", "[fused]")
{
    const std::string isa = choose_isa().name;
    Scene scene = note_scene();
    CHECK(in_registers(scene, isa));
    SECTION("a quadric without an end")
    {
        scene.objects.push_back(make_object(clip(cylinder(), -1, 1)));
        CHECK(in_registers(scene, isa));
        scene.objects.push_back(make_object(cylinder()));
        CHECK_FALSE(in_registers(scene, isa));
    }
    SECTION("many objects")
    {
        for (int i = 0; i < 40; ++i)
            scene.objects.push_back(make_object(sphere(Vec3(i, 5, 9), 0.3)));
        CHECK_FALSE(in_registers(scene, isa));
    }
    SECTION("objects that crowd")
    {
        for (int i = 0; i < 8; ++i)
            scene.objects.push_back(make_object(sphere(Vec3(0.1 * i, 0, 9), 3)));
        CHECK_FALSE(in_registers(scene, isa));
    }
    SECTION("weights that are cut")
    {
        scene.min_weight = 0.1;
        CHECK_FALSE(in_registers(scene, isa));
    }
}

}  // namespace packtrace::test
