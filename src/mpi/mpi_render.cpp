#include "cli/interrupts.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/render/band_file.hpp"
#include "cli/render/render_animation.hpp"
#include "cli/render/render_arguments.hpp"
#include "cli/render/render_bands.hpp"
#include "cli/render/render_picture.hpp"
#include "core/cut_rays.hpp"
#include "core/seconds_since.hpp"
#include "mpi/commands.hpp"
#include "scene/language/quote.hpp"

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace packtrace::mpi {
namespace {

using cli::BandFile;
using cli::Bands;
using cli::FinishedBand;
using cli::RenderArguments;

struct RenderJobArguments : RenderArguments {
    JobArguments job;
};

/// The picture on rank 0: bands of an earlier run, and bands that arrive.
class Assembly {
public:
    Assembly(const RenderJobArguments& arguments, const Scene& scene, const RenderOptions& options)
        : arguments_(arguments),
          file_(arguments, scene, options, cli::band_pixels),
          bar_(arguments.quiet ? cli::Verbosity::quiet : cli::Verbosity::normal)
    {
        for (int number = 0; number < file_.bands().count(); ++number)
            if (!file_.kept(number))
                missing_.push_back(number);
        note_progress();
    }

    /// The numbers of bands to render.
    [[nodiscard]] const std::vector<int>& missing() const
    {
        return missing_;
    }

    /// Adds the next missing band.
    void take(Piece piece)
    {
        const int number = missing_[static_cast<std::size_t>(piece.number)];
        write_kept(number);
        const FinishedBand band{std::move(piece.bytes), piece.cut};
        file_.keep(number, band);
        write(band);
        note_progress();
    }

    void finish()
    {
        write_kept(file_.bands().count());
        file_.commit();
        cli::set_interrupt_line("");
    }

    /// Prints on standard error how many bands an earlier run finished, and how many rays were cut.
    void print_summary(const Scene& scene, const RenderOptions& options) const
    {
        const int count = file_.bands().count();
        cli::print_found_bands(arguments_.output, count - static_cast<int>(missing_.size()), count);
        cli::print_cut_rays(arguments_.output, scene, options, cut_);
    }

private:
    void write(const FinishedBand& band)
    {
        cut_ += band.cut;
        file_.write(band.samples);
        bar_.update(static_cast<double>(++written_) / file_.bands().count());
    }

    /// Writes the bands of an earlier run, up to `end`.
    void write_kept(int end)
    {
        while (written_ < end)
            if (const std::optional<FinishedBand> band = file_.kept(written_))
                write(*band);
            else
                throw FileError(arguments_.output +
                                ".part: has changed since this run began; start the run again");
    }

    void note_progress() const
    {
        const std::string bands =
            std::to_string(written_) + " of " + std::to_string(file_.bands().count()) + " bands";
        cli::set_interrupt_line(arguments_.resume
                                    ? "the job ended with " + bands + " of " + arguments_.output +
                                          " written; the same command goes on with them"
                                    : "the job ended after " + bands + " of " + arguments_.output +
                                          ", which are lost; with --resume they are kept");
    }

    const RenderJobArguments& arguments_;
    BandFile file_;
    cli::ProgressBar bar_;
    std::vector<int> missing_;
    CutRays cut_;
    int written_ = 0;
};

/// Renders the missing bands on all ranks. The assembly on rank 0 receives them.
std::vector<RankReport> render_bands(const World& world, const RenderJobArguments& arguments,
                                     const Scene& scene, const RenderOptions& options,
                                     const std::vector<int>& missing, Assembly* assembly)
{
    std::optional<RowSamples> samples;
    cli::RenderBand render;
    world.together([&] {
        samples.emplace(arguments.output, scene.width, arguments.write.gamma);
        render = cli::band_renderer(scene, cli::chosen_precision(arguments.kernel.precision),
                                    options, *samples);
    });
    const Bands bands =
        cli::cut_into_bands(scene.width, scene.height, samples->format(), cli::band_pixels);
    const std::size_t band_bytes = samples->row_bytes() * static_cast<std::size_t>(bands.rows);
    Job job(world, static_cast<int>(missing.size()), window_of(world.size(), band_bytes));
    const auto make = [&](int number, RankReport& report) {
        const Bands::Band band = bands.band(missing[static_cast<std::size_t>(number)]);
        Piece piece;
        piece.bytes.resize(samples->row_bytes() * static_cast<std::size_t>(band.rows));
        const FrameCounts counts = render(band, piece.bytes);
        piece.cut = counts.cut;
        report.rays += counts.total();
        return piece;
    };
    return job.run(make, [&](Piece piece) { assembly->take(std::move(piece)); });
}

void render_picture(const World& world, const RenderJobArguments& arguments, const Scene& scene,
                    const RenderOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    std::unique_ptr<Assembly> assembly;
    world.together([&] {
        if (world.is_first())
            assembly = std::make_unique<Assembly>(arguments, scene, options);
    });
    std::vector<int> missing = assembly ? assembly->missing() : std::vector<int>();
    world.broadcast(missing);
    const std::vector<RankReport> reports =
        render_bands(world, arguments, scene, options, missing, assembly.get());
    world.together([&] {
        if (assembly)
            assembly->finish();
    });
    if (assembly && !arguments.quiet)
        assembly->print_summary(scene, options);
    print_report(world, {.output = arguments.output,
                         .pieces = "bands",
                         .ranks = reports,
                         .seconds = seconds_since(start),
                         .quiet = arguments.quiet,
                         .json = arguments.job.json});
}

/// On rank 0: the sum of the frames and cut rays of all ranks.
cli::FrameTally sum_of_ranks(const cli::FrameTally& mine)
{
    cli::FrameTally all;
    MPI_Reduce(&mine.rendered, &all.rendered, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Reduce(&mine.skipped, &all.skipped, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Reduce(&mine.replaced, &all.replaced, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Reduce(&mine.cut.rays, &all.cut.rays, 1, MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Reduce(&mine.cut.bound, &all.cut.bound, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    return all;
}

/// Renders the frames that this rank gets.
cli::FrameTally render_turns(const RenderJobArguments& arguments, const Scene& scene,
                             const RenderOptions& options, const FrameRange& range,
                             cli::FrameOutput& output, cli::ProgressBar& bar, const Job::Next& next)
{
    const auto next_frame = [&]() -> std::optional<int> {
        const std::int64_t number = next();
        if (number >= range.count())
            return std::nullopt;
        return range.first + static_cast<int>(number);
    };
    // Frames are distributed in order, so this rank's frame shows the share of the animation.
    const auto show = [&](int frame, double share) {
        bar.update((frame - range.first + share) / range.count());
    };
    return cli::render_frames(arguments, scene, options, output, next_frame, show);
}

void print_frames(const RenderJobArguments& arguments, const Scene& scene,
                  const RenderOptions& options, const cli::FrameTally& all)
{
    if (all.skipped + all.replaced > 0)
        std::cerr << language::escape(arguments.output) << ": " << all.skipped
                  << " frames were there already, " << all.replaced
                  << " were rendered in place of other pictures\n";
    if (all.rendered > 0)
        cli::print_cut_rays(arguments.output, scene, options, all.cut);
}

void render_frames(const World& world, const RenderJobArguments& arguments, const Scene& scene,
                   const RenderOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    FrameRange range;
    std::unique_ptr<cli::FrameOutput> output;
    world.together([&] {
        range = cli::frames_of(arguments.animation, scene);
        output = cli::frame_files(arguments, scene, options);
    });
    if (world.is_first())
        cli::set_interrupt_line("the job ended before all frames of " + arguments.output +
                                " were written; the same command renders the missing ones");
    cli::ProgressBar bar(arguments.quiet || !world.is_first() ? cli::Verbosity::quiet
                                                              : cli::Verbosity::normal);
    Job job(world, 0, 0);
    cli::FrameTally tally;
    const std::vector<RankReport> reports = job.run([&](const Job::Next& next, RankReport& report) {
        tally = render_turns(arguments, scene, options, range, *output, bar, next);
        report.pieces = tally.rendered;
        report.busy = tally.rendering;
    });
    cli::set_interrupt_line("");
    const cli::FrameTally all = sum_of_ranks(tally);
    if (world.is_first() && !arguments.quiet)
        print_frames(arguments, scene, options, all);
    print_report(world, {.output = arguments.output,
                         .pieces = "frames",
                         .ranks = reports,
                         .seconds = seconds_since(start),
                         .quiet = arguments.quiet,
                         .json = arguments.job.json});
}

void run_render(const World& world, const RenderJobArguments& arguments)
{
    RenderOptions options;
    world.together([&] {
        options = cli::checked_render_options(arguments);
        if (world.is_first() && !arguments.animation.many())
            check_image_writable(arguments.output);
    });
    check_ranks(world, options, arguments.job.mixing());
    Scene scene = shared_scene(world, arguments.scene);
    world.together([&] {
        cli::apply(arguments.picture, scene);
        if (arguments.animation.frame)
            cli::go_to_frame(scene, *arguments.animation.frame);
    });
    cli::limit_threads(options.threads, 2);
    if (arguments.animation.many())
        render_frames(world, arguments, scene, options);
    else
        render_picture(world, arguments, scene, options);
}

/// Replaces an option that an MPI job does not support by a hidden one that says why. CLI11's own
/// messages lack the names of hidden options. So the new one takes any value or none, any number of
/// times, and needs no other option.
void refuse(CLI::App& command, const std::string& option, const std::string& why)
{
    command.remove_option(command.get_option(option));
    command
        .add_option_function<std::string>(
            option, [=](const std::string&) { throw CLI::ValidationError(option + ": " + why); })
        ->expected(0, 1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->group("");
}

void refuse_options(CLI::App& command)
{
    refuse(command, "--certainty", "packtrace render writes it");
    refuse(command, "--y4m", "ranks write frames; give --frames, and make a video of the pictures");
    refuse(command, "--fps", "is of videos, and ranks write frames; leave it out");
    refuse(command, "--shard", "ranks share the frames by themselves; leave it out");
}

}  // namespace

void add_render(CLI::App& app, const World& world)
{
    CLI::App* command = app.add_subcommand("render", "Render a scene to a picture on all ranks");
    const auto arguments = std::make_shared<RenderJobArguments>();
    cli::add_render_options(*command, *arguments);
    refuse_options(*command);
    add_job_options(*command, arguments->job);
    command->callback([arguments, &world] { run_render(world, *arguments); });
}

}  // namespace packtrace::mpi
