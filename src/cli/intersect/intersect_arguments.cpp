#include "cli/intersect/intersect_arguments.hpp"

#include "cli/options/scene_input.hpp"
#include "cli/options/validators.hpp"
#include "cli/render/frame_recipe.hpp"

namespace packtrace::cli {
namespace {

// Not add_kernel_options(): here double is the default and the widest precision.
void add_options(CLI::App& command, KernelArguments& arguments)
{
    add_kernel_option(command, arguments.kernel);
    arguments.precision = "double";
    add_precision_option(command, arguments.precision, "double (default) or single");
    add_traversal_option(command, arguments.traversal);
    add_accuracy_option(command, arguments.accuracy);
    add_isa_and_width(command, arguments.isa);
    add_threads_option(command, arguments.threads);
}

}  // namespace

void add_intersect_options(CLI::App& command, IntersectArguments& arguments)
{
    add_scene_option(command, arguments.scene);
    command
        .add_option("RAYS", arguments.rays,
                    "CSV of ox,oy,oz,dx,dy,dz[,t_min,t_max]; - is standard input")
        ->required()
        ->check(file_name())
        ->type_name("");
    command
        .add_option("-o,--output", arguments.output,
                    "CSV to write (default standard output): hit,t,object,nx,ny,nz")
        ->check(file_name())
        ->type_name("FILE");
    CLI::Option* all = command.add_flag(
        "--all", arguments.all, "Write every hit of each ray in order: ray,t,object,nx,ny,nz");
    CLI::Option* any =
        command.add_flag("--any", arguments.any, "Write only whether a ray hits anything: hit")
            ->excludes(all);
    command
        .add_flag(
            "--bounds", arguments.bounds,
            "Add columns t_low,t_high: proven bounds of each t, which take longer than the hits")
        ->excludes(any);
    add_options(command, arguments.kernel);
    command.add_flag("--resume", arguments.resume,
                     "Keep finished rows beside FILE until it is complete; after an "
                     "interruption, the same command goes on with them");
}

RenderOptions checked_intersect_options(const IntersectArguments& arguments)
{
    if (arguments.scene == "-" && arguments.rays == "-")
        throw CLI::ValidationError(
            "RAYS: standard input holds the scene or the rays, not both; give a file for one");
    if (arguments.resume && (arguments.output.empty() || arguments.output == "-"))
        throw CLI::ValidationError("--resume: standard output keeps nothing; give -o FILE");
    return render_options(arguments.kernel);
}

std::string hits_recipe(const IntersectArguments& arguments, const Scene& scene,
                        const RenderOptions& options)
{
    RenderArguments kernel;
    kernel.kernel = arguments.kernel;
    // Hits do not depend on the picture's options.
    Scene without_picture = scene;
    set_usual_picture(without_picture);
    std::string recipe = FrameRecipe(kernel, without_picture, options).of(Camera{});
    recipe += arguments.all ? ", --all" : arguments.any ? ", --any" : "";
    return recipe + (arguments.bounds ? ", --bounds" : "");
}

}  // namespace packtrace::cli
