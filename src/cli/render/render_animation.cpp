#include "cli/render/render_animation.hpp"

#include "cli/options/shard.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/output/text_table.hpp"
#include "cli/render/render_picture.hpp"
#include "core/cut_rays.hpp"
#include "core/job_queue.hpp"
#include "core/seconds_since.hpp"
#include "image/formats.hpp"
#include "image/y4m.hpp"
#include "render/frame_numbers.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/animate.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string_view>

namespace packtrace::cli {
namespace {

/// Returns `call()`. Turns std::invalid_argument into a wrong use of `option`.
template <class Call>
auto checked(const std::string& option, const Call& call)
{
    try {
        return call();
    } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError(option + ": " + error.what());
    }
}

/// Extensions of video formats that --y4m does not write.
constexpr std::array<std::string_view, 6> other_videos{".mp4",  ".mkv", ".mov",
                                                       ".webm", ".avi", ".gif"};

void check_video_name(const std::string& output)
{
    const std::filesystem::path file(output);
    if (find_image_format(file))
        throw CLI::ValidationError("--y4m: '" + output +
                                   "' is the name of a picture; give a video's, such as film.y4m");
    const std::string extension = file.extension().string();
    if (std::count(other_videos.begin(), other_videos.end(), extension) > 0)
        throw CLI::ValidationError("--y4m: writes YUV4MPEG2, not " + extension +
                                   "; write it to -, and let an encoder make '" + output +
                                   "' of it: --y4m -o - | ffmpeg -i - " + output);
}

/// "1.2 s, 40.0 ms each"
std::string seconds_text(double seconds, int frames)
{
    return fixed(seconds, 1) + " s, " + fixed(1e3 * seconds / frames, 1) + " ms each";
}

/// Renders a frame and adds its time to the tally.
AnyImage render_frame(const Scene& scene, Precision precision, const RenderOptions& options,
                      FrameTally& tally)
{
    const auto start = std::chrono::steady_clock::now();
    CutRays cut;
    AnyImage image = render_picture(scene, precision, options, &cut);
    tally.cut += cut;
    tally.rendering += seconds_since(start);
    ++tally.rendered;
    return image;
}

}  // namespace

FrameRange frames_of(const AnimationArguments& arguments, const Scene& scene)
{
    const std::string option = arguments.frames ? "--frames" : "--y4m";
    return checked(option, [&] {
        if (!scene.animation)
            throw std::invalid_argument("the scene has no animation");
        const int frames = scene.animation->frames;
        FrameRange range{0, frames - 1};
        if (arguments.frames) {
            range = parse_frame_range(*arguments.frames);
            check_frame_range(range, frames);
        }
        // Check all cameras first, because a frame without a view would end the work halfway.
        for (int frame = range.first; frame <= range.last; ++frame)
            (void)camera_at(scene, frame);
        return range;
    });
}

void print_tally(const std::string& output, const FrameTally& tally)
{
    std::string text =
        language::escape(output) + ": " + counted(tally.rendered, "frame") + " rendered";
    if (tally.rendered > 0)
        text += " in " + seconds_text(tally.rendering, tally.rendered) + "; written in " +
                seconds_text(tally.writing, tally.rendered) + "; both in " +
                fixed(tally.seconds, 1) + " s";
    if (tally.replaced > 0)
        text += ", " + std::to_string(tally.replaced) +
                " in place of pictures of another scene, other options or another version";
    if (tally.skipped > 0)
        text += ", " + std::to_string(tally.skipped) +
                " were there already (--overwrite renders them again)";
    std::cerr << text << '\n';
}

FrameTally render_frames(const RenderArguments& arguments, const Scene& scene,
                         RenderOptions options, FrameOutput& output, const NextFrame& next,
                         const ShowFrame& show)
{
    const auto start = std::chrono::steady_clock::now();
    const Precision precision = chosen_precision(arguments.kernel.precision);
    FrameTally tally;
    Scene posed = scene;
    JobQueue writer;
    while (const std::optional<int> frame = next()) {
        posed.camera = camera_at(scene, *frame);
        const FrameOutput::Found found = output.find(*frame, posed.camera);
        if (found == FrameOutput::Found::same && !arguments.animation.overwrite) {
            output.skip(*frame);
            ++tally.skipped;
            continue;
        }
        tally.replaced += found == FrameOutput::Found::other ? 1 : 0;
        options.progress = [&](double share) { show(*frame, share); };
        writer.add([&output, number = *frame, camera = posed.camera,
                    image = render_frame(posed, precision, options, tally)] {
            output.write(number, camera, image);
        });
    }
    writer.finish();
    output.finish();
    tally.writing = writer.seconds();
    tally.seconds = seconds_since(start);
    return tally;
}

void add_animation_options(CLI::App& command, AnimationArguments& arguments)
{
    command.add_option("--frame", arguments.frame, "Render one frame of the scene's animation")
        ->check(whole_number(0, 999999))
        ->type_name("N");
    command
        .add_option(
            "--frames", arguments.frames,
            "Render these frames, both ends included; IMAGE has a %d or %04d for the "
            "number; frames that are there already, of the same scene, options and version, are "
            "skipped")
        ->type_name("A..B");
    command.add_flag("--overwrite", arguments.overwrite,
                     "Render frames that are there already, too");
    add_shard_option(
        command, arguments.shard,
        "Of --frames A..B every Nth only, from A + I on: the part of machine I, from 0, of N");
    CLI::Option* const y4m = command.add_flag(
        "--y4m", arguments.y4m,
        "Write the frames (default all) as one YUV4MPEG2 video; IMAGE is a file or -");
    command
        .add_option("--fps", arguments.fps,
                    "Frames per second of --y4m, such as 24, 23.976 or 30000/1001 (default 30)")
        ->needs(y4m)
        ->check(parsed_by(parse_frame_rate,
                          "a number of frames per second, up to 1000, such as 24, 23.976 or "
                          "30000/1001"))
        ->type_name("N");
}

void check_animation_options(const RenderArguments& arguments)
{
    const AnimationArguments& animation = arguments.animation;
    if (animation.frame && animation.many())
        throw CLI::ValidationError("--frame: one frame only; leave out --frames and --y4m");
    if (animation.many() && arguments.resume)
        throw CLI::ValidationError(
            "--resume: is for one picture; --frames goes on with missing frames by itself");
    if (animation.overwrite && (!animation.frames || animation.y4m))
        throw CLI::ValidationError("--overwrite: only --frames into picture files skips any");
    if (animation.shard && (!animation.frames || animation.y4m))
        throw CLI::ValidationError("--shard: cuts --frames into picture files only");
    if (animation.y4m)
        check_video_name(arguments.output);
    if (animation.frames)
        (void)checked("--frames", [&] { return parse_frame_range(*animation.frames); });
    if (animation.frames && !animation.y4m)
        (void)checked("--output", [&] { return FramePattern(arguments.output); });
}

void go_to_frame(Scene& scene, int frame)
{
    scene.camera = checked("--frame", [&] { return camera_at(scene, frame); });
}

void render_animation(const RenderArguments& arguments, const Scene& scene,
                      const RenderOptions& options)
{
    const FrameRange range = frames_of(arguments.animation, scene);
    const auto output =
        arguments.animation.y4m ? frame_stream(arguments) : frame_files(arguments, scene, options);
    const Shard shard = parse_shard(arguments.animation.shard.value_or("0/1")).value();
    ProgressBar bar(arguments.quiet ? Verbosity::quiet : Verbosity::normal);
    int following = range.first + shard.index;
    const auto next = [&]() -> std::optional<int> {
        const int frame = following;
        if (frame > range.last)
            return std::nullopt;
        following += shard.count;
        return frame;
    };
    // The bar shows the share of the whole animation.
    const auto show = [&](int frame, double share) {
        bar.update((frame - range.first + share) / range.count());
    };
    const FrameTally tally = render_frames(arguments, scene, options, *output, next, show);
    if (arguments.quiet)
        return;
    const std::string name = arguments.output == "-" ? "standard output" : arguments.output;
    print_tally(name, tally);
    if (tally.rendered > 0)
        print_cut_rays(name, scene, options, tally.cut);
}

}  // namespace packtrace::cli
