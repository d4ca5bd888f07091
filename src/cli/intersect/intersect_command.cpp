#include <memory>
#include <string>

#include "cli/command.hpp"
#include "cli/intersect/intersect_rays.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"

namespace packtrace::cli {
namespace {

struct IntersectArguments {
    std::string scene;
    std::string rays;
    std::string output;
    KernelArguments kernel;
    bool all = false;
    bool any = false;
    bool bounds = false;
};

RayQuery query_of(const IntersectArguments& arguments)
{
    return arguments.all ? RayQuery::all : arguments.any ? RayQuery::any : RayQuery::closest;
}

void run_intersect(const IntersectArguments& arguments)
{
    const RenderOptions options = render_options(arguments.kernel);
    if (arguments.scene == "-" && arguments.rays == "-")
        throw CLI::ValidationError(
            "RAYS: standard input holds the scene or the rays, not both; give a file for one");
    const ThreadLimit limit(options.threads);
    // Before the work, so that a wrong name doesn't cost it.
    TextOutput output(arguments.output);
    const Scene scene = read_scene_input(arguments.scene).scene;
    RayBlocks rays(arguments.rays);
    const RayBounds bounds = arguments.bounds ? RayBounds::proven : RayBounds::none;
    if (arguments.kernel.precision == "single")
        intersect_rays<float>(scene, options, query_of(arguments), bounds, rays, output);
    else
        intersect_rays<double>(scene, options, query_of(arguments), bounds, rays, output);
}

// Not add_kernel_options: here double is the default, and nothing is wider.
void add_options(CLI::App& command, KernelArguments& arguments)
{
    command.add_option("--kernel", arguments.kernel, "packet (default), or the scalar reference")
        ->check(one_of({"packet", "scalar"}))
        ->type_name("packet|scalar");
    arguments.precision = "double";
    command.add_option("--precision", arguments.precision, "double (default) or single")
        ->check(one_of({"single", "double"}))
        ->type_name("single|double");
    add_traversal_option(command, arguments.traversal);
    add_accuracy_options(command, arguments.accuracy);
    add_isa_options(command, arguments.isa);
    add_threads_option(command, arguments.threads);
}

}  // namespace

void add_intersect(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("intersect", "Say where rays of your own meet a scene's objects");
    const auto arguments = std::make_shared<IntersectArguments>();
    add_scene_option(*command, arguments->scene);
    command
        ->add_option("RAYS", arguments->rays,
                     "CSV of ox,oy,oz,dx,dy,dz[,t_min,t_max]; - is standard input")
        ->required()
        ->type_name("");
    command
        ->add_option("-o,--output", arguments->output,
                     "CSV to write (default standard output): hit,t,object,nx,ny,nz")
        ->type_name("FILE");
    CLI::Option* all = command->add_flag(
        "--all", arguments->all, "Write every hit of each ray in order: ray,t,object,nx,ny,nz");
    CLI::Option* any =
        command->add_flag("--any", arguments->any, "Write only whether a ray hits anything: hit")
            ->excludes(all);
    command
        ->add_flag("--bounds", arguments->bounds,
                   "Write proven bounds of each t, too: t_low,t_high; some 10 µs a hit")
        ->excludes(any);
    add_options(*command, arguments->kernel);
    command->callback([arguments] { run_intersect(*arguments); });
}

}  // namespace packtrace::cli
