#include "cli/render/render_bands.hpp"

#include "cli/interrupts.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/render/band_file.hpp"
#include "core/cut_rays.hpp"
#include "core/job_queue.hpp"
#include "core/seconds_since.hpp"
#include "kernel_abi/kernel_table.hpp"
#include "render/precision.hpp"
#include "render/row_renderer.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace packtrace::cli {
namespace {

template <class Real>
RenderBand band_renderer(const Scene& scene, const RenderOptions& options,
                         const RowSamples& samples)
{
    return [render = row_renderer<Real>(scene, options), samples, width = scene.width,
            image = Image<Real>()](const Bands::Band& band, std::span<std::uint8_t> bytes) mutable {
        if (image.height != band.rows)
            image = Image<Real>::unset(width, band.rows);
        const FrameCounts counts = render(band.first, image);
        samples.encode(std::span<const Real>(image.rgb), bytes.data());
        return counts;
    };
}

/// Sets the message for an interruption: what the run leaves behind.
void note_progress(const RenderArguments& arguments, int done, int bands)
{
    if (arguments.resume)
        set_interrupt_line("interrupted with " + std::to_string(done) + " of " +
                           std::to_string(bands) + " bands of " + arguments.output +
                           " finished; the same command goes on with them");
}

}  // namespace

Bands cut_into_bands(int width, int height, ImageFormat format, std::int64_t pixels)
{
    const std::int64_t tile_row = std::int64_t{abi::tile_size} * width;
    const std::int64_t tiles = std::clamp<std::int64_t>(pixels / tile_row, 1, 4096);
    return {width, height, static_cast<int>(tiles) * abi::tile_size, RowFile::begins_below(format)};
}

RenderBand band_renderer(const Scene& scene, Precision precision, const RenderOptions& options,
                         const RowSamples& samples)
{
    return with_real(precision,
                     [&]<class Real>() { return band_renderer<Real>(scene, options, samples); });
}

BandTally render_bands(const RenderArguments& arguments, const Scene& scene,
                       const RenderOptions& given)
{
    BandFile file(arguments, scene, given, band_pixels);
    BandTally tally;
    tally.bands = file.bands().count();
    ProgressBar bar(arguments.quiet ? Verbosity::quiet : Verbosity::normal);
    int number = 0;
    RenderOptions options = given;
    options.progress = [&](double share) { bar.update((number + share) / tally.bands); };
    const RenderBand render =
        band_renderer(scene, chosen_precision(arguments.kernel.precision), options, file.samples());

    note_progress(arguments, 0, tally.bands);
    JobQueue writer;
    for (; number < tally.bands; ++number) {
        if (std::optional<FinishedBand> kept = file.kept(number)) {
            note_progress(arguments, number + 1, tally.bands);
            ++tally.found;
            tally.cut += kept->cut;
            writer.add([&file, samples = std::move(kept->samples)] { file.write(samples); });
            continue;
        }
        FinishedBand band{Bytes(file.band_bytes(number)), {}};
        const auto start = std::chrono::steady_clock::now();
        band.cut = render(file.bands().band(number), band.samples).cut;
        tally.cut += band.cut;
        tally.rendering += seconds_since(start);
        writer.add([&, number, band = std::move(band)] {
            file.keep(number, band);
            note_progress(arguments, number + 1, tally.bands);
            file.write(band.samples);
        });
    }
    writer.finish();
    file.commit();
    set_interrupt_line("");
    tally.writing = writer.seconds();
    return tally;
}

}  // namespace packtrace::cli
