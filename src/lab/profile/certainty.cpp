#include "core/arena.hpp"
#include "dispatch/kernels.hpp"
#include "lab/profile/observed_frame.hpp"
#include "lab/profile/work_rows.hpp"
#include "render/check_options.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include <packtrace/certainty.hpp>

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <stdexcept>
#include <utility>

namespace packtrace {
namespace {

RenderOptions checked(const RenderOptions& options)
{
    if (options.kernel != Kernel::packet)
        throw std::invalid_argument(
            "certainty: the scalar kernel decides in one precision alone; ask for packets");
    if (options.accuracy != Accuracy::exact)
        throw std::invalid_argument(
            "certainty: fast accuracy traces no ray again; ask for exact accuracy");
    if (options.adaptive)
        throw std::invalid_argument(
            "certainty: adaptive sampling has pixels of different numbers of rays; give all the "
            "same number of samples");
    return checked_options(options);
}

/// What the kernels record about one tile.
struct TileRecord {
    abi::WorkCounts counts;
    std::array<abi::PixelRays, abi::tile_pixels> pixels;
    abi::Observation observation;

    TileRecord()
    {
        observation.generations = 1;
        observation.counts = &counts;
        observation.pixels = pixels.data();
    }
};

/// Threads may call it at once: tiles have no pixels in common.
void take_pixels(const TileRecord& record, const Region& tile, Certainty& certainty)
{
    for_each_pixel(tile, [&](int number, int x, int y) {
        const abi::PixelRays& rays = record.pixels[static_cast<std::size_t>(number)];
        certainty.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(certainty.width) +
                         static_cast<std::size_t>(x)] = {rays.traced, rays.unsure, rays.undecided};
    });
}

Certainty observe_tiles(const Scene& scene, const RenderOptions& options)
{
    const TileRenderer<float> tiles(
        scene, observable(lower(scene, options.accuracy, options.self_hits)),
        kernels_of(choose_isa(options.isa, options.width).name), options);
    Certainty certainty;
    certainty.width = scene.width;
    certainty.height = scene.height;
    Image<float> image(scene.width, scene.height);
    certainty.pixels.resize(image.rgb.size() / 3);
    const TileGrid grid({0, 0, scene.width, scene.height});
    Progress done(grid.count(), options.progress);
    tbb::enumerable_thread_specific<UnsureCounts> unsure(
        UnsureCounts(std::size_t{abi::cause_count}));
    certainty.rays = for_each_piece(grid, done, [&](const Region& tile) {
        TileRecord record;
        const abi::RayCounts counts = tiles.render(image, tile, &record.observation);
        take_pixels(record, tile, certainty);
        add_causes(record.counts, unsure.local());
        return counts;
    });
    certainty.unsure.resize(abi::cause_count);
    for (const UnsureCounts& some : unsure)
        for (std::size_t cause = 0; cause < some.size(); ++cause)
            certainty.unsure[cause] += some[cause];
    for (const PixelCertainty& pixel : certainty.pixels)
        certainty.undecided += pixel.undecided;
    return certainty;
}

}  // namespace

Certainty find_certainty(const Scene& scene, const RenderOptions& options)
{
    checked(options);
    return run_on_threads(options.threads, [&] { return observe_tiles(scene, options); });
}

Image<float> certainty_picture(const Certainty& certainty)
{
    Image<float> image(certainty.width, certainty.height);
    if (3 * certainty.pixels.size() != image.rgb.size())
        throw std::invalid_argument("certainty of " + std::to_string(certainty.pixels.size()) +
                                    " pixels for a picture of " + std::to_string(image.width) +
                                    " x " + std::to_string(image.height) + "; give as many");
    float* rgb = image.rgb.data();
    for (const PixelCertainty& pixel : certainty.pixels) {
        if (pixel.rays > 0) {
            const auto rays = static_cast<float>(pixel.rays);
            rgb[0] = static_cast<float>(pixel.unsure) / rays;
            rgb[2] = static_cast<float>(pixel.undecided) / rays;
        }
        rgb += 3;
    }
    return image;
}

}  // namespace packtrace
