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

bool in_registers(const Scene& scene, const std::string& isa, Accuracy accuracy = Accuracy::exact)
{
    LoweredScene lowered = lower(scene, accuracy);
    prune(lowered);
    const auto& table = precision<float>(kernels_of(isa));
    const PackedScene<float> packed(lowered,
                                    frame_traversal(lowered, Traversal::automatic, table.lanes));
    return fused_for(table, lowered.features, packed.view()) != nullptr;
}

/// Whether kernels are compiled that trace frames of this mode in registers.
bool has_registers(const std::string& isa, Accuracy accuracy)
{
    const bool has_feature_sets =
        precision<float>(kernels_of(isa)).kernels[0].render_tiles != nullptr;
    return accuracy == Accuracy::exact || has_feature_sets;
}

struct Frame {
    Image<float> image;
    abi::RayCounts counts;
};

/// Renders in tiles, as frames are; with `force_general`, in streams of the general kernel.
Frame render_tiles(const Scene& scene, const std::string& isa, const RenderOptions& options)
{
    const TileRenderer<float> tiles(scene, lower_for<float>(scene, options), kernels_of(isa),
                                    options);
    Frame frame{Image<float>(scene.width, scene.height), {}};
    const TileGrid grid({0, 0, scene.width, scene.height});
    for (int tile = 0; tile < grid.count(); ++tile)
        frame.counts += tiles.render(frame.image, grid[tile]);
    return frame;
}

/// The same frame in registers, if the scene allows, and in streams.
struct BothWays {
    Frame registers;
    Frame streams;

    BothWays(const Scene& scene, const std::string& isa, RenderOptions options = {})
        : registers(render_tiles(scene, isa, options))
    {
        options.force_general = true;
        streams = render_tiles(scene, isa, options);
    }
};

Scene note_scene()
{
    return read_scene(std::string(PACKTRACE_SOURCE_DIR) + "/scenes/four_spheres.scene");
}

}  // namespace

TEST_CASE("paths in registers give the same bits as streams", "[fused]")
{
    const Accuracy accuracy = GENERATE(Accuracy::exact, Accuracy::fast);
    unsigned traced = 0;
    unsigned possible = 0;
    for (unsigned seed = 1; seed <= scene_count(150); ++seed) {
        const Scene scene = FewObjects(seed).scene;
        for (const std::string& isa : supported_isas()) {
            traced += in_registers(scene, isa, accuracy);
            possible += has_registers(isa, accuracy);
            CAPTURE(seed, isa, accuracy == Accuracy::exact);
            const BothWays frames(scene, isa, {.accuracy = accuracy});
            CHECK(same_bits(frames.registers.image, frames.streams.image));
        }
    }
    CHECK(traced >= possible / 2);
}

TEST_CASE("paths in registers trace the same rays as streams", "[fused]")
{
    const Accuracy accuracy = GENERATE(Accuracy::exact, Accuracy::fast);
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa, accuracy == Accuracy::exact);
        const BothWays frames(note_scene(), isa, {.accuracy = accuracy});
        const abi::RayCounts& streams = frames.streams.counts;
        const abi::RayCounts& registers = frames.registers.counts;
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
        const BothWays frames(scene, isa, {.samples = 4});
        CHECK(same_bits(frames.registers.image, frames.streams.image));
    }
    RenderOptions options{.samples = 8, .adaptive = 0.05};
    const Image<float> registers = render<float>(scene, options);
    options.force_general = true;
    CHECK(same_bits(registers, render<float>(scene, options)));
}

TEST_CASE("fast mode traces in registers where kernels are compiled for feature sets", "[fused]")
{
    Scene scene = note_scene();
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        CHECK(in_registers(scene, isa, Accuracy::fast) == has_registers(isa, Accuracy::fast));
    }
    // More objects are traced in registers only if no ray is reflected.
    const std::string isa = choose_isa().name;
    for (int i = 0; i < 20; ++i)
        scene.objects.push_back(make_object(sphere(Vec3(0.5 * i, 5, 9), 0.1)));
    CHECK_FALSE(in_registers(scene, isa, Accuracy::fast));
    scene.max_depth = 0;
    CHECK(in_registers(scene, isa, Accuracy::fast) ==
          in_registers(note_scene(), isa, Accuracy::fast));
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
