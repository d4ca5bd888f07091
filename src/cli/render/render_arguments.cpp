#include "cli/render/render_arguments.hpp"

#include <cstdio>
#include <iostream>

#include "cli/options/scene_input.hpp"
#include "cli/options/validators.hpp"
#include "cli/render/render_animation.hpp"
#include "cli/study/certainty_option.hpp"
#include "image/format.hpp"
#include "scene/quote.hpp"

namespace packtrace::cli {
namespace {

void check_gamma(const RenderArguments& arguments)
{
    if (arguments.write.gamma != 1.0 && !arguments.animation.y4m &&
        image_format(arguments.output) != ImageFormat::png)
        throw CLI::ValidationError("--gamma: only PNG has one; .pfm and .hdr hold linear values");
}

}  // namespace

void add_render_options(CLI::App& command, RenderArguments& arguments)
{
    add_scene_option(command, arguments.scene);
    command.add_option("-o,--output", arguments.output, "Picture to write: .png, .pfm or .hdr")
        ->required()
        ->type_name("IMAGE");
    command
        .add_option("--certainty", arguments.certainty,
                    "Picture of where single precision was unsure: red is the share of a pixel's "
                    "rays traced again in double, blue of those that double can't decide either")
        ->type_name("IMAGE");
    add_kernel_options(command, arguments.kernel);
    add_picture_options(command, arguments.picture);
    add_sampling_options(command, arguments.sampling);
    add_animation_options(command, arguments.animation);
    command
        .add_option("--gamma", arguments.write.gamma,
                    "Raise a PNG's or video's values to 1/G; 1 (default) writes them linear")
        ->check(positive_number())
        ->type_name("G");
    command.add_flag("--resume", arguments.resume,
                     "Keep finished bands of the picture beside it until it is complete; after an "
                     "interruption, the same command goes on with them");
    command.add_flag("-q,--quiet", arguments.quiet, "No progress bar, no summary");
}

RenderOptions checked_options(const RenderArguments& arguments)
{
    RenderOptions options = render_options(arguments.kernel);
    apply(arguments.sampling, options);
    check_animation_options(arguments);
    check_gamma(arguments);
    // Before the work, so that a wrong name doesn't cost it.
    if (arguments.certainty)
        check_certainty(arguments, options);
    return options;
}

void print_summary(const RenderArguments& arguments, const RenderOptions& options,
                   const Scene& scene, double seconds, double writing)
{
    const Region part = options.region.value_or(Region{0, 0, scene.width, scene.height});
    const std::string kernel =
        options.kernel == Kernel::scalar ? "scalar" : "packet, " + options.isa;
    const double pixels = static_cast<double>(part.width) * part.height;
    char text[192];
    std::snprintf(text, sizeof text,
                  ": %d x %d, %s, %s, %.1f ms, %.1f Mpixel/s; written in %.1f ms\n", part.width,
                  part.height, kernel.c_str(), arguments.kernel.precision.c_str(), 1e3 * seconds,
                  1e-6 * pixels / seconds, 1e3 * writing);
    std::cerr << language::escape(arguments.output) << text;
}

}  // namespace packtrace::cli
