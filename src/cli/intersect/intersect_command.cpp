#include "cli/command.hpp"
#include "cli/intersect/hit_output.hpp"
#include "cli/intersect/intersect_arguments.hpp"
#include "cli/intersect/intersect_rays.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/shard.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/output/distinct_files.hpp"
#include "render/precision.hpp"

#include <iostream>
#include <memory>
#include <string>

namespace packtrace::cli {
namespace {

template <class Real>
void run(const IntersectArguments& arguments, const Scene& scene, const RenderOptions& options,
         RayBlocks& rays, HitOutput& output)
{
    BlockTracer<Real> tracer(scene, options, arguments.query(), arguments.ray_bounds());
    intersect_rays<Real>(tracer, rays, [&](const RayBlock& block, std::string_view rows) {
        output.take(block.text, rows);
    });
    if (arguments.shard)
        output.end_part();
    output.finish();
}

void run_intersect(const IntersectArguments& arguments)
{
    const RenderOptions options = checked_intersect_options(arguments);
    limit_threads(options.threads);
    // Check before the work, so that a wrong name costs no time.
    if (!arguments.output.empty())
        check_writable(arguments.output);
    check_not_read(arguments.output, {arguments.scene, arguments.rays});
    const Scene scene = read_scene_input(arguments.scene).scene;
    RayRange range;
    std::string recipe = hits_recipe(arguments, scene, options);
    std::string header(header_of(arguments.query(), arguments.ray_bounds()));
    if (arguments.shard) {
        const Shard shard = *parse_shard(*arguments.shard);
        range = numbered_rays(arguments.rays, static_cast<std::uint64_t>(shard.index),
                              static_cast<std::uint64_t>(shard.count));
        const PartHead head{shard, recipe + ", " + std::to_string(ray_file_size(arguments.rays)) +
                                       " bytes of rays, checksum " +
                                       std::to_string(ray_file_checksum(arguments.rays))};
        header = head.line() + header;
        recipe += ", --shard " + shard.text();
    }
    RayBlocks rays(arguments.rays, range);
    HitOutput output(arguments, recipe, header);
    output.skip_finished([&] { return rays.next().text; });
    with_packet_real(chosen_precision(arguments.kernel.precision),
                     [&]<class Real>() { run<Real>(arguments, scene, options, rays, output); });
}

}  // namespace

void add_intersect(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("intersect", "Find where rays of your own hit a scene's objects");
    const auto arguments = std::make_shared<IntersectArguments>();
    add_intersect_options(*command, *arguments);
    add_shard_option(*command, arguments->shard,
                     "Answer part I, from 0, of N parts of the rays; packtrace join makes one "
                     "file of the parts");
    command->callback([arguments] { run_intersect(*arguments); });
}

}  // namespace packtrace::cli
