// Mirrored rays sorted over many tiles give the same colours as the rays of each tile alone, bit
// for bit.
#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "few_objects.hpp"
#include "lower/packed_scene.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include <packtrace/build.hpp>
#include <packtrace/generate.hpp>

#include <span>

namespace packtrace::test {
namespace {

template <class Real>
struct Picture {
    Image<Real> image;
    abi::RayCounts counts;
};

constexpr int block = abi::block_edge * abi::tile_size;

/// Renders in square pieces with sides of `edge`; rays of a single tile are not sorted.
template <class Real>
Picture<Real> render_pieces(const TileRenderer<Real>& tiles, const Scene& scene, int edge)
{
    Picture<Real> picture{Image<Real>(scene.width, scene.height), {}};
    const TileGrid grid({0, 0, scene.width, scene.height}, edge);
    for (int piece = 0; piece < grid.count(); ++piece)
        picture.counts += tiles.render(picture.image, grid[piece]);
    return picture;
}

template <class Real>
void check_same(const Picture<Real>& a, const Picture<Real>& b)
{
    CHECK(same_bits(a.image, b.image));
    CHECK(a.counts.camera == b.counts.camera);
    CHECK(a.counts.shadow == b.counts.shadow);
    CHECK(a.counts.reflected == b.counts.reflected);
    CHECK(a.counts.refracted == b.counts.refracted);
    CHECK(a.counts.cut == b.counts.cut);
    CHECK(a.counts.lacks == b.counts.lacks);
}

/// Whether `part` equals the bits of `whole` from pixel (x, y) on.
bool is_cut_from(const Image<float>& whole, int x, int y, const Image<float>& part)
{
    const auto row_of = [&](const Image<float>& image, int left, int row) {
        return std::span(image.pixel(left, row), 3 * static_cast<std::size_t>(part.width));
    };
    for (int row = 0; row < part.height; ++row)
        if (!same_bits(row_of(part, 0, row), row_of(whole, x, y + row)))
            return false;
    return true;
}

/// Compares the blocks of a picture with its tiles; returns false without a comparison if frames
/// are not rendered in blocks.
template <class Real>
bool check_blocks(const Scene& scene, RenderOptions options)
{
    const TileRenderer<Real> tiles(scene,
                                   lower(scene, accuracy_in<Real>(options), options.self_hits),
                                   kernels_of(options.isa), options);
    if (tiles.block_edge({0, 0, scene.width, scene.height}, 1) == abi::tile_size)
        return false;
    const Picture<Real> alone = render_pieces(tiles, scene, abi::tile_size);
    check_same(render_pieces(tiles, scene, block), alone);
    check_same(render_pieces(tiles, scene, block / 2), alone);
    options.force_general = true;
    const TileRenderer<Real> general(scene,
                                     lower(scene, accuracy_in<Real>(options), options.self_hits),
                                     kernels_of(options.isa), options);
    CHECK(general.block_edge({0, 0, scene.width, scene.height}, 1) == abi::tile_size);
    const Picture<Real> by_all = render_pieces(general, scene, abi::tile_size);
    CHECK(same_bits(by_all.image, alone.image));
    return true;
}

Scene flake()
{
    Scene scene = generate_sphereflake({.depth = 3, .reflective = 0.5, .ground = true});
    set_size(scene, 275, 150);
    return scene;
}

Scene mirrors()
{
    Scene scene = generate_random_spheres({.count = 2000, .radius = 0.03, .reflective = 0.8});
    scene.max_depth = 6;
    set_size(scene, 130, 260);
    return scene;
}

/// Every other sphere has a mirror of another colour.
Scene tinted()
{
    Scene scene = make_scene(Illumination::general);
    for (int i = 0; i < 400; ++i) {
        Material material = make_material(scene.illumination);
        auto& general = std::get<GeneralMaterial>(material.model);
        general.diffuse = Rgb(0.4);
        general.reflect = i % 2 == 0 ? Rgb(0.9, 0.5, 0.2) : Rgb(0.2, 0.6, 0.9);
        scene.objects.push_back(
            make_object(sphere(Vec3(i % 20 - 10, i / 20 - 10, 14 + i % 7), 0.55), material));
    }
    scene.lights.push_back(point_light(Vec3(3, 9, -4), Rgb(0.7)));
    scene.max_depth = 5;
    set_size(scene, 200, 140);
    return scene;
}

}  // namespace

TEST_CASE("sorted mirrored rays give the same bits as tiles alone", "[sorted]")
{
    for (const Scene& scene : {flake(), mirrors(), tinted()})
        for (const std::string& isa : supported_isas()) {
            CAPTURE(isa);
            RenderOptions options{.isa = isa};
            CHECK(check_blocks<float>(scene, options));
            options.accuracy = Accuracy::fast;
            CHECK(check_blocks<float>(scene, options));
        }
}

TEST_CASE("mirrored rays are sorted in double, by the notes' rule, with cuts and many samples too",
          "[sorted]")
{
    Scene scene = flake();
    RenderOptions options{.isa = choose_isa().name};
    CHECK(check_blocks<double>(scene, options));
    options.samples = 4;
    CHECK(check_blocks<float>(scene, options));
    options.samples = 1;
    options.self_hits = SelfHits::note;
    CHECK(check_blocks<float>(scene, options));
    options.self_hits = SelfHits::exact;
    scene.min_weight = 0.3;
    CHECK(check_blocks<float>(scene, options));
}

TEST_CASE("rays of a bvh with few objects of any kind can be sorted", "[sorted]")
{
    int sorted = 0;
    for (unsigned seed = 1; seed <= 150; ++seed) {
        Scene scene = FewObjects(seed).scene;
        set_size(scene, 150, 40);
        CAPTURE(seed);
        RenderOptions options{.isa = choose_isa().name, .traversal = Traversal::tree};
        // In the default mode few objects are traced in registers.
        options.accuracy = Accuracy::fast;
        sorted += check_blocks<float>(scene, options);
        options.accuracy = Accuracy::exact;
        scene.min_weight = 1e-6;
        sorted += check_blocks<float>(scene, options);
    }
    CHECK(sorted > 100);
}

TEST_CASE("frames are the same for any number of threads and for a region", "[sorted]")
{
    const Scene scene = flake();
    RenderOptions options{.threads = 1};
    const Image<float> whole = render<float>(scene, options);
    options.threads = 3;
    const Image<float> by_three = render<float>(scene, options);
    CHECK(same_bits(whole, by_three));
    options.region = Region{101, 33, 150, 90};
    const Image<float> part = render<float>(scene, options);
    CHECK(is_cut_from(whole, 101, 33, part));
}

TEST_CASE("memory for some tiles together is enough for fewer tiles at any depth", "[sorted]")
{
    Scene scene = mirrors();
    scene.max_depth = 64;
    const LoweredScene lowered = lower(scene);
    const PackedScene<float> packed(lowered);
    for (const std::string& isa : supported_isas())
        for (const auto& kernels : precision<float>(kernels_of(isa)).kernels) {
            if (kernels.scratch_bytes == nullptr)
                continue;
            CAPTURE(isa, kernels.set.name);
            for (int tiles = 2; tiles <= abi::block_tiles; ++tiles)
                for (int fewer = 1; fewer < tiles; ++fewer)
                    CHECK(kernels.scratch_bytes(packed.view(), fewer) <=
                          kernels.scratch_bytes(packed.view(), tiles));
        }
}

TEST_CASE("deep small pictures are those of lists, by tiles alone and together", "[sorted]")
{
    Scene scene = mirrors();
    scene.max_depth = 64;
    set_size(scene, 48, 32);
    RenderOptions options{.traversal = Traversal::list, .threads = 1};
    const Image<float> by_list = render<float>(scene, options);
    options.traversal = Traversal::tree;
    for (const int threads : {1, 2}) {
        options.threads = threads;
        const Image<float> by_tree = render<float>(scene, options);
        CHECK(same_bits(by_list, by_tree));
    }
    options.region = Region{0, 0, 5, 5};
    const Image<float> part = render<float>(scene, options);
    CHECK(is_cut_from(by_list, 0, 0, part));
}

TEST_CASE("only scenes with mirrors in a bvh sort their rays", "[sorted]")
{
    const auto edge = [](const Scene& scene) {
        const RenderOptions options{.isa = choose_isa().name};
        return TileRenderer<float>(scene, lower(scene), kernels_of(options.isa), options)
            .block_edge({0, 0, 1024, 1024}, 2);
    };
    CHECK(edge(flake()) == block);
    CHECK(edge(generate_sphereflake({.depth = 3})) == abi::tile_size);
    Scene glass = tinted();
    std::get<GeneralMaterial>(glass.objects[7].material.model).transmit = Rgb(0.5);
    CHECK(edge(glass) == abi::tile_size);
    CHECK(edge(FewObjects(1).scene) == abi::tile_size);
}

}  // namespace packtrace::test
