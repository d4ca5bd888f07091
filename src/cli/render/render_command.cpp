#include "cli/command.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/render/render_animation.hpp"
#include "cli/render/render_arguments.hpp"
#include "cli/render/render_bands.hpp"
#include "cli/render/render_picture.hpp"
#include "cli/study/study.hpp"
#include "core/seconds_since.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/render.hpp>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

namespace packtrace::cli {
namespace {

/// Prints the times of a picture on standard error.
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

/// Renders a picture that is held in memory as a whole.
void render_whole(const RenderArguments& arguments, const Scene& scene, RenderOptions options)
{
    const auto start = std::chrono::steady_clock::now();
    AnyImage picture;
    CutRays cut;
    {
        ProgressBar bar(arguments.quiet ? Verbosity::quiet : Verbosity::normal);
        options.progress = [&bar](double share) { bar.update(share); };
        picture =
            render_picture(scene, chosen_precision(arguments.kernel.precision), options, &cut);
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
    if (options.region || (pixels <= most_whole_pixels && !arguments.resume)) {
        render_whole(arguments, scene, options);
    } else {
        const BandTally tally = render_bands(arguments, scene, options);
        if (!arguments.quiet) {
            print_found_bands(arguments.output, tally.found, tally.bands);
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
    RenderOptions options = checked_render_options(arguments);
    check_region_options(arguments);
    if (!arguments.animation.many())
        check_image_writable(arguments.output);
    Scene scene = read_scene_input(arguments.scene).scene;
    apply(arguments.picture, scene);
    options.region = region_of(arguments, scene);
    if (arguments.certainty)
        check_certainty_size(scene);
    // One more thread writes frames of an animation and bands of a picture.
    limit_threads(options.threads, 1);
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
    add_render_options(*command, *arguments);
    add_region_option(*command, *arguments);
    command->callback([arguments] { run_render(*arguments); });
}

}  // namespace packtrace::cli
