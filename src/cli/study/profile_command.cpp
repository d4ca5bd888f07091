#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/output/output.hpp"
#include "cli/study/profile_print.hpp"
#include "core/atomic_file.hpp"
#include "core/check_number.hpp"
#include "core/json_text.hpp"
#include "render/precision.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/profile.hpp>

#include <iostream>
#include <memory>

namespace packtrace::cli {
namespace {

struct ProfileArguments {
    std::string scene;
    std::string precision = "single";
    AccuracyArguments accuracy;
    IsaArguments isa;
    PictureArguments picture;
    SamplingArguments sampling;
    int threads = 1;
    int repetitions = 9;
    std::string heatmap;
    std::string trace;
    bool json = false;
};

ProfileOptions profile_options(const ProfileArguments& arguments)
{
    RenderOptions sampling;
    apply(arguments.sampling, sampling);
    apply(arguments.accuracy, "packet", chosen_precision(arguments.precision), sampling);
    return {.isa = chosen_isa(arguments.isa).name,
            .threads = arguments.threads,
            .samples = sampling.samples,
            .adaptive = sampling.adaptive,
            .accuracy = sampling.accuracy,
            .self_hits = sampling.self_hits,
            .repetitions = arguments.repetitions};
}

template <class Real>
void write_extras(const ProfileArguments& arguments, const Scene& scene,
                  const ProfileOptions& options)
{
    if (!arguments.heatmap.empty())
        write_image(arguments.heatmap,
                    cost_picture(pixel_costs<Real>(scene, options), scene.width, scene.height));
    if (!arguments.trace.empty()) {
        Output output(arguments.trace);
        output.write(trace_json(trace_tiles<Real>(scene, options)).dump() + "\n");
        output.finish();
    }
}

template <class Real>
void profile_as(const ProfileArguments& arguments, const SceneInput& input)
{
    const Scene& scene = input.scene;
    const ProfileOptions options = profile_options(arguments);
    limit_threads(options.threads);
    const Profile result = profile<Real>(input.text, scene, options);
    write_extras<Real>(arguments, scene, options);
    if (arguments.json)
        std::cout << json_text(profile_json(input.name, result));
    else
        print_profile(std::cout, input.name, result);
}

void run_profile(const ProfileArguments& arguments)
{
    (void)profile_options(arguments);
    // Check before the work, so that a wrong name costs no time.
    if (!arguments.heatmap.empty())
        check_image_writable(arguments.heatmap);
    if (!arguments.trace.empty())
        check_writable(arguments.trace);
    check_two_files(arguments.heatmap, arguments.trace);
    check_not_read(arguments.heatmap, {arguments.scene});
    check_not_read(arguments.trace, {arguments.scene});
    SceneInput input = read_scene_input(arguments.scene);
    apply(arguments.picture, input.scene);
    with_packet_real(chosen_precision(arguments.precision),
                     [&]<class Real>() { profile_as<Real>(arguments, input); });
}

}  // namespace

void add_profile(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("profile", "Show where the time of a frame goes");
    const auto arguments = std::make_shared<ProfileArguments>();
    add_scene_option(*command, arguments->scene);
    add_precision_option(*command, arguments->precision, "single (default) or double");
    add_accuracy_and_self_hits(*command, arguments->accuracy);
    add_isa_and_width(*command, arguments->isa);
    add_picture_options(*command, arguments->picture);
    add_sampling_options(*command, arguments->sampling);
    command->add_option("--threads", arguments->threads, "Threads (default 1)")
        ->check(whole_number(1, most_threads))
        ->type_name("N");
    command->add_option("--repetitions", arguments->repetitions, "Frames of each kind (default 9)")
        ->check(whole_number(1, most_repetitions))
        ->type_name("N");
    command
        ->add_option("--heatmap", arguments->heatmap, "Write a picture of the cost of each pixel")
        ->check(file_name())
        ->type_name("IMAGE");
    command
        ->add_option("--trace", arguments->trace,
                     "Write the tiles of a frame over threads, for Perfetto or chrome://tracing")
        ->check(own_file_name())
        ->type_name("FILE");
    command->add_flag("--json", arguments->json, "Print JSON");
    command->callback([arguments] { run_profile(*arguments); });
}

}  // namespace packtrace::cli
