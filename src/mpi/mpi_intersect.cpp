#include "cli/interrupts.hpp"
#include "cli/intersect/hit_output.hpp"
#include "cli/intersect/intersect_arguments.hpp"
#include "cli/intersect/intersect_rays.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/output/distinct_files.hpp"
#include "core/checksum.hpp"
#include "core/seconds_since.hpp"
#include "mpi/commands.hpp"
#include "render/precision.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace packtrace::mpi {
namespace {

using cli::RayCount;
using cli::RayRange;

struct IntersectJobArguments : cli::IntersectArguments {
    JobArguments job;

    [[nodiscard]] bool json_on_rows() const
    {
        return job.json && output.empty();
    }
};

/// The file of rays, divided into ranges. Their number depends only on the file.
class RayPieces {
public:
    explicit RayPieces(const std::string& file) : file_(file)
    {
        constexpr std::uint64_t least = std::uint64_t{1} << 16;
        constexpr std::uint64_t most = std::uint64_t{1} << 23;
        constexpr std::uint64_t most_pieces = 30000;
        const std::uint64_t size = cli::ray_file_size(file);
        const std::uint64_t piece = std::clamp(size / 1024, least, most);
        count_ = std::clamp<std::uint64_t>(size / piece, 1, most_pieces);
        format_ = cli::format_of_rays(file);
    }

    [[nodiscard]] int count() const
    {
        return static_cast<int>(count_);
    }

    /// Counts the lines and rays before each range. Each rank counts a share of the file.
    void number(const World& world)
    {
        std::vector<std::uint64_t> counts(2 * count_);
        world.together([&] {
            for (auto i = static_cast<std::uint64_t>(world.rank()); i < count_;
                 i += static_cast<std::uint64_t>(world.size())) {
                const RayCount count = cli::count_rays(file_, range(i));
                counts[2 * i] = count.lines;
                counts[2 * i + 1] = count.rays;
            }
        });
        before_.resize(2 * count_);
        MPI_Allreduce(counts.data(), before_.data(), static_cast<int>(counts.size()), MPI_UINT64_T,
                      MPI_SUM, MPI_COMM_WORLD);
        std::uint64_t lines = 0;
        std::uint64_t rays = 0;
        for (std::size_t i = 0; i < before_.size(); i += 2) {
            const std::uint64_t end = lines + before_[i];
            const std::uint64_t own_rays = before_[i + 1];
            before_[i] = std::exchange(lines, end);
            before_[i + 1] = rays;
            // After comments longer than a piece, the header was counted as a ray.
            const bool has_header =
                i > 0 && format_.header_line > before_[i] && format_.header_line <= end;
            rays += own_rays - (has_header ? 1 : 0);
        }
    }

    /// A range, with its numbers if they were counted.
    [[nodiscard]] RayRange range(std::uint64_t i) const
    {
        RayRange range = cli::cut_rays(file_, i, count_);
        if (range.begin > 0)
            range.format = format_;
        // Without line numbers no line is the header.
        if (before_.empty()) {
            range.format.header_line = 0;
        } else {
            range.first_line += before_[2 * i];
            range.first_ray = before_[2 * i + 1];
        }
        return range;
    }

    /// A range with its numbers, which this rank counts alone.
    [[nodiscard]] RayRange numbered(std::uint64_t i) const
    {
        return cli::numbered_rays(file_, i, count_);
    }

    /// Identifies the text of a range.
    [[nodiscard]] std::string mark(std::uint64_t i) const
    {
        const RayRange part = range(i);
        cli::TextBlocks blocks(file_, part.begin, part.end);
        std::uint32_t sum = 0;
        for (std::string text = blocks.next(); !text.empty(); text = blocks.next())
            sum = checksum(bytes_of(text), sum);
        return std::to_string(sum);
    }

private:
    std::string file_;
    std::uint64_t count_ = 1;
    cli::RayFormat format_;
    std::vector<std::uint64_t> before_;  ///< lines and rays, alternating
};

/// The rows of a range.
template <class Real>
Bytes rows_of(cli::BlockTracer<Real>& tracer, const std::string& file, const RayRange& range,
              RankReport& report)
{
    cli::RayBlocks blocks(file, range);
    Bytes all;
    std::uint64_t rays = 0;
    cli::intersect_rays<Real>(tracer, blocks,
                              [&](const cli::RayBlock& block, std::string_view rows) {
                                  all.insert(all.end(), rows.begin(), rows.end());
                                  rays += block.rays;
                              });
    report.rays += rays;
    return all;
}

template <class Real>
std::vector<RankReport> trace(const World& world, const IntersectJobArguments& arguments,
                              const Scene& scene, const RenderOptions& options,
                              const RayPieces& pieces, cli::HitOutput* output, int finished)
{
    std::unique_ptr<cli::BlockTracer<Real>> tracer;
    world.together([&] {
        tracer = std::make_unique<cli::BlockTracer<Real>>(scene, options, arguments.query(),
                                                          arguments.ray_bounds());
    });
    Job job(world, pieces.count() - finished, window_of(world.size(), std::size_t{1} << 23));
    const auto make = [&](int number, RankReport& report) {
        const auto i = static_cast<std::uint64_t>(number + finished);
        Piece piece;
        try {
            piece.bytes = rows_of(*tracer, arguments.rays, pieces.range(i), report);
        } catch (const FileError&) {
            // Repeat it with numbers, so that the message has the right line.
            piece.bytes = rows_of(*tracer, arguments.rays, pieces.numbered(i), report);
        }
        return piece;
    };
    return job.run(make, [&](const Piece& piece) {
        const std::string mark =
            arguments.resume ? pieces.mark(static_cast<std::uint64_t>(piece.number + finished))
                             : std::string();
        output->take(mark, {reinterpret_cast<const char*>(piece.bytes.data()), piece.bytes.size()});
    });
}

/// Checks before any work. Throws for options that a job of rays does not support.
void check_job(const World& world, const IntersectJobArguments& arguments)
{
    if (arguments.json_on_rows())
        throw CLI::ValidationError("--json: standard output has the rows; give -o FILE");
    if (world.is_first() && !arguments.output.empty())
        check_writable(arguments.output);
    cli::check_not_read(arguments.output, {arguments.scene, arguments.rays});
}

/// The options and the file of rays, which all ranks check before any work.
struct IntersectSetup {
    RenderOptions options;
    std::unique_ptr<RayPieces> pieces;
};

IntersectSetup check_together(const World& world, const IntersectJobArguments& arguments)
{
    IntersectSetup setup;
    world.together([&] {
        setup.options = cli::checked_intersect_options(arguments);
        check_job(world, arguments);
        setup.pieces = std::make_unique<RayPieces>(arguments.rays);
    });
    check_ranks(world, setup.options, arguments.job.mixing());
    return setup;
}

/// Opens the output on rank 0, after the rows that an earlier run finished.
std::unique_ptr<cli::HitOutput> open_output(const IntersectJobArguments& arguments,
                                            const Scene& scene, const RenderOptions& options,
                                            const RayPieces& pieces)
{
    const std::string recipe = cli::hits_recipe(arguments, scene, options) + ", " +
                               std::to_string(pieces.count()) + " pieces of rays";
    auto output = std::make_unique<cli::HitOutput>(
        arguments, recipe, cli::header_of(arguments.query(), arguments.ray_bounds()));
    std::uint64_t number = 0;
    output->skip_finished([&] { return pieces.mark(number++); });
    if (!arguments.resume)
        cli::set_interrupt_line(
            "the job ended before all rays were answered; with --resume finished rows are kept");
    return output;
}

void run_intersect(const World& world, const IntersectJobArguments& arguments)
{
    const auto start = std::chrono::steady_clock::now();
    const IntersectSetup setup = check_together(world, arguments);
    const RenderOptions& options = setup.options;
    RayPieces& pieces = *setup.pieces;
    const Scene scene = shared_scene(world, arguments.scene);
    cli::limit_threads(options.threads, 2);
    if (arguments.all)
        pieces.number(world);

    std::unique_ptr<cli::HitOutput> output;
    std::vector<int> finished{0};
    world.together([&] {
        if (!world.is_first())
            return;
        output = open_output(arguments, scene, options, pieces);
        finished[0] = static_cast<int>(output->finished());
    });
    world.broadcast(finished);
    const std::vector<RankReport> reports =
        with_packet_real(cli::chosen_precision(arguments.kernel.precision), [&]<class Real>() {
            return trace<Real>(world, arguments, scene, options, pieces, output.get(), finished[0]);
        });
    world.together([&] {
        if (output)
            output->finish();
    });
    cli::set_interrupt_line("");
    print_report(world, {.output = arguments.output,
                         .pieces = "pieces of rays",
                         .ranks = reports,
                         .seconds = seconds_since(start),
                         .quiet = arguments.output.empty(),
                         .json = arguments.job.json});
}

}  // namespace

void add_intersect(CLI::App& app, const World& world)
{
    CLI::App* command = app.add_subcommand(
        "intersect", "Find where rays of your own hit a scene's objects, on all ranks");
    const auto arguments = std::make_shared<IntersectJobArguments>();
    cli::add_intersect_options(*command, *arguments);
    add_job_options(*command, arguments->job);
    command->callback([arguments, &world] { run_intersect(world, *arguments); });
}

}  // namespace packtrace::mpi
