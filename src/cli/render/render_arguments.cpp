#include "cli/render/render_arguments.hpp"

#include "cli/options/scene_input.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/render/render_animation.hpp"
#include "cli/study/study.hpp"
#include "image/formats.hpp"
#include "render/check_options.hpp"

#include <array>
#include <stdexcept>
#include <string_view>

namespace packtrace::cli {
namespace {

void check_gamma(const RenderArguments& arguments)
{
    if (arguments.write.gamma != 1.0 && !arguments.animation.y4m &&
        image_format(arguments.output) != ImageFormat::png)
        throw CLI::ValidationError("--gamma: only PNG has one; .pfm and .hdr hold linear values");
}

/// Reads four whole numbers "X,Y,W,H". Not set for other text.
std::optional<Region> parse_region(std::string_view text)
{
    const std::optional<std::array<int, 4>> numbers = parse_numbers<4>(text, ',');
    if (!numbers)
        return std::nullopt;
    const auto [x, y, width, height] = *numbers;
    return Region{x, y, width, height};
}

}  // namespace

void add_render_options(CLI::App& command, RenderArguments& arguments)
{
    add_scene_option(command, arguments.scene);
    command.add_option("-o,--output", arguments.output, "Picture to write: .png, .pfm or .hdr")
        ->required()
        ->check(file_name())
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

RenderOptions checked_render_options(const RenderArguments& arguments)
{
    RenderOptions options = render_options(arguments.kernel);
    apply(arguments.sampling, options);
    check_animation_options(arguments);
    check_not_read(arguments.output, {arguments.scene});
    check_gamma(arguments);
    // Check before the work, so that a wrong name costs no time.
    if (arguments.certainty)
        check_certainty(arguments, options);
    return options;
}

void add_region_option(CLI::App& command, RenderArguments& arguments)
{
    command
        .add_option(
            "--region", arguments.region,
            "Render a part of the picture alone: column and row of its first pixel, from "
            "the upper left, its width and height (default all of it). Not with --resume or "
            "--certainty")
        ->check(parsed_by(parse_region,
                          "a region such as 100,50,320,240: column and row of its first pixel, "
                          "width and height"))
        ->type_name("X,Y,W,H");
}

void check_region_options(const RenderArguments& arguments)
{
    if (!arguments.region)
        return;
    if (arguments.resume)
        throw CLI::ValidationError("--region: can't be resumed; leave out --resume");
    if (arguments.certainty)
        throw CLI::ValidationError("--region: --certainty is of whole pictures; leave one out");
}

std::optional<Region> region_of(const RenderArguments& arguments, const Scene& scene)
{
    if (!arguments.region)
        return std::nullopt;
    const RenderOptions options{.region = parse_region(*arguments.region)};
    try {
        return checked_region(options, scene);
    } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError(std::string("--") + error.what());
    }
}

}  // namespace packtrace::cli
