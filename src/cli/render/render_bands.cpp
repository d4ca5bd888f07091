#include "cli/render/render_bands.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "cli/interrupts.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/render/band_file.hpp"
#include "core/job_queue.hpp"
#include "core/seconds_since.hpp"

namespace packtrace::cli {
namespace {

/// Says what an interrupted run leaves.
void note_progress(const RenderArguments& arguments, int done, int bands)
{
    if (arguments.resume)
        set_interrupt_line("packtrace: interrupted with " + std::to_string(done) + " of " +
                           std::to_string(bands) + " bands of " + arguments.output +
                           " finished; the same command goes on with them");
}

void add(CutRays& sum, const CutRays& some)
{
    sum.rays += some.rays;
    sum.bound = std::max(sum.bound, some.bound);
}

}  // namespace

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
    const auto source = band_source(scene, arguments.kernel.precision, options, file.samples());

    JobQueue writer;
    for (; number < tally.bands; ++number) {
        if (std::optional<FinishedBand> kept = file.kept(number)) {
            ++tally.found;
            add(tally.cut, kept->cut);
            writer.add([&file, samples = std::move(kept->samples)] { file.write(samples); });
            continue;
        }
        FinishedBand band{Bytes(file.band_bytes(number)), {}};
        const auto start = std::chrono::steady_clock::now();
        band.cut = source->render(file.bands().band(number), band.samples).cut;
        add(tally.cut, band.cut);
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
