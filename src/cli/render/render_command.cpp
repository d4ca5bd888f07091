#include <packtrace/render.hpp>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

#include <packtrace/image_io.hpp>

#include "cli/command.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/render/cut_rays.hpp"
#include "cli/render/render_animation.hpp"
#include "cli/render/render_bands.hpp"
#include "cli/render/render_picture.hpp"
#include "cli/study/certainty_option.hpp"
#include "image/format.hpp"
#include "scene/quote.hpp"

namespace packtrace::cli {
namespace {

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to)
{
    return std::chrono::duration<double>(to - from).count();
}

void print_summary(const RenderArguments& arguments, const RenderOptions& options,
                   const Scene& scene, double seconds, double writing)
{
    const std::string kernel =
        options.kernel == Kernel::scalar ? "scalar" : "packet, " + options.isa;
    const double pixels = static_cast<double>(scene.width) * scene.height;
    char text[192];
    std::snprintf(text, sizeof text,
                  ": %d x %d, %s, %s, %.1f ms, %.1f Mpixel/s; written in %.1f ms\n", scene.width,
                  scene.height, kernel.c_str(), arguments.kernel.precision.c_str(), 1e3 * seconds,
                  1e-6 * pixels / seconds, 1e3 * writing);
    std::cerr << language::escape(arguments.output) << text;
}

void check_gamma(const RenderArguments& arguments)
{
    if (arguments.write.gamma != 1.0 && !arguments.animation.y4m &&
        image_format(arguments.output) != ImageFormat::png)
        throw CLI::ValidationError("--gamma: only PNG has one; .pfm and .hdr hold linear values");
}

void print_found(const RenderArguments& arguments, const BandTally& tally)
{
    if (tally.found > 0)
        std::cerr << arguments.output << ": " << tally.found << " of " << tally.bands
                  << " bands were finished by an earlier run\n";
}

/// A picture that is held as a whole until it is written.
void render_whole(const RenderArguments& arguments, const Scene& scene, RenderOptions options)
{
    const auto start = std::chrono::steady_clock::now();
    AnyImage picture;
    CutRays cut;
    {
        ProgressBar bar(arguments.quiet ? Verbosity::quiet : Verbosity::normal);
        options.progress = [&bar](double share) { bar.update(share); };
        picture = render_picture(scene, arguments.kernel.precision, options, &cut);
    }
    const auto rendered = std::chrono::steady_clock::now();
    write_picture(arguments.output, picture, arguments.write);
    const auto written = std::chrono::steady_clock::now();
    if (arguments.quiet)
        return;
    print_summary(arguments, options, scene, seconds_between(start, rendered),
                  seconds_between(rendered, written));
    print_cut_rays(arguments.output, scene, options, cut);
}

void render_one(const RenderArguments& arguments, const Scene& scene, const RenderOptions& options)
{
    const std::int64_t pixels = std::int64_t{scene.width} * scene.height;
    if (pixels <= most_whole_pixels && !arguments.resume) {
        render_whole(arguments, scene, options);
    } else {
        const BandTally tally = render_bands(arguments, scene, options);
        if (!arguments.quiet) {
            print_found(arguments, tally);
            print_summary(arguments, options, scene, tally.rendering, tally.writing);
            print_cut_rays(arguments.output, scene, options, tally.cut);
        }
    }
    if (!arguments.certainty)
        return;
    const std::string line = write_certainty(arguments, scene, options);
    if (!arguments.quiet)
        std::cerr << line << '\n';
}

void run_render(const RenderArguments& arguments)
{
    RenderOptions options = render_options(arguments.kernel);
    apply(arguments.sampling, options);
    check_animation_options(arguments);
    check_gamma(arguments);
    // Before the work, so that a wrong name doesn't cost it.
    if (arguments.certainty)
        check_certainty(arguments, options);
    if (!arguments.animation.many())
        check_image_writable(arguments.output);
    Scene scene = read_scene_input(arguments.scene).scene;
    apply(arguments.picture, scene);
    // Frames of an animation and bands of a picture are written by one more.
    const ThreadLimit limit(options.threads, 1);
    if (arguments.animation.many())
        return render_animation(arguments, scene, options);
    if (arguments.animation.frame)
        go_to_frame(scene, *arguments.animation.frame);
    render_one(arguments, scene, options);
}

}  // namespace

void add_render(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("render", "Render a scene to a picture");
    const auto arguments = std::make_shared<RenderArguments>();
    add_scene_option(*command, arguments->scene);
    command->add_option("-o,--output", arguments->output, "Picture to write: .png, .pfm or .hdr")
        ->required()
        ->type_name("IMAGE");
    command
        ->add_option("--certainty", arguments->certainty,
                     "Picture of where single precision was unsure: red is the share of a pixel's "
                     "rays traced again in double, blue of those that double can't decide either")
        ->type_name("IMAGE");
    add_kernel_options(*command, arguments->kernel);
    add_picture_options(*command, arguments->picture);
    add_sampling_options(*command, arguments->sampling);
    add_animation_options(*command, arguments->animation);
    command
        ->add_option("--gamma", arguments->write.gamma,
                     "Raise a PNG's or video's values to 1/G; 1 (default) writes them linear")
        ->check(positive_number())
        ->type_name("G");
    command->add_flag("--resume", arguments->resume,
                      "Keep finished bands of the picture beside it until it is complete; after an "
                      "interruption, the same command goes on with them");
    command->add_flag("-q,--quiet", arguments->quiet, "No progress bar, no summary");
    command->callback([arguments] { run_render(*arguments); });
}

}  // namespace packtrace::cli
