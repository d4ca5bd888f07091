#include "cli/options/common_options.hpp"

#include "cli/options/validators.hpp"
#include "render/check_options.hpp"
#include "render/precision.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace packtrace::cli {
namespace {

// The limits of the scene language.
constexpr int largest_side = 65536;
constexpr int most_depth = 64;
constexpr int adaptive_samples = 16;

/// Reads width and height from "640x480", in pixels. Not set if they are not valid sides.
std::optional<std::array<int, 2>> parse_size(std::string_view text)
{
    const std::optional<std::array<int, 2>> sides = parse_numbers<2>(text, 'x');
    const auto is_side = [](int side) { return side >= 1 && side <= largest_side; };
    if (!sides || !std::all_of(sides->begin(), sides->end(), is_side))
        return std::nullopt;
    return sides;
}

}  // namespace

void add_accuracy_option(CLI::App& command, AccuracyArguments& arguments)
{
    add_word_option(command, "--accuracy", arguments.accuracy,
                    "How single-precision packets find hits. fast: in single precision alone. "
                    "exact (default): uncertain decisions are made in double, every hit is "
                    "refined in double",
                    words_of<Accuracy>());
}

void add_accuracy_and_self_hits(CLI::App& command, AccuracyArguments& arguments)
{
    add_accuracy_option(command, arguments);
    add_word_option(command, "--self-hits", arguments.self_hits,
                    "How secondary rays avoid hitting the surface they start on. note: they start "
                    "0.001 along their direction. exact: they never hit it where they start, only "
                    "where they truly hit it again (default " +
                        std::string(language::word_of(default_self_hits)) + ")",
                    words_of<SelfHits>());
}

void add_traversal_option(CLI::App& command, std::optional<std::string>& traversal)
{
    add_word_option(command, "--traversal", traversal,
                    "How packets find objects: one by one (list), through a hierarchy of "
                    "boxes (tree), or as suits their number (auto, default)",
                    words_of<Traversal>());
}

void add_isa_option(CLI::App& command, std::optional<std::string>& isa, const std::string& meaning)
{
    // Also sets that do not run here, because completion scripts may be made for other machines.
    std::vector<std::string> names{"auto"};
    for (const IsaInfo& each : list_isas())
        names.push_back(each.name);
    command.add_option("--isa", isa, meaning)->check(offers(names))->type_name("NAME");
}

void add_isa_and_width(CLI::App& command, IsaArguments& arguments)
{
    add_isa_option(command, arguments.isa,
                   "Instruction set (default PACKTRACE_ISA, else the widest; see info)");
    command
        .add_option("--width", arguments.width,
                    "Instruction set by the rays of a packet in single precision: 1, 4, 8 or 16 "
                    "(default the most); doubles have half as many")
        ->check(one_of({"1", "4", "8", "16"}))
        ->type_name("N");
}

void add_size_option(CLI::App& command, PictureArguments& arguments)
{
    command
        .add_option("--size", arguments.size,
                    "Size of the picture (default " + arguments.size.value_or("the scene's") + ")")
        ->check(parsed_by(parse_size, "a size such as 640x480, of sides from 1 to " +
                                          std::to_string(largest_side)))
        ->type_name("WxH");
}

void add_picture_options(CLI::App& command, PictureArguments& arguments)
{
    add_size_option(command, arguments);
    command
        .add_option("--depth", arguments.depth,
                    "Reflections after the camera ray (default the scene's)")
        ->check(whole_number(0, most_depth))
        ->type_name("N");
    command
        .add_option("--min-weight", arguments.min_weight,
                    "Leave out mirrored and refracted rays whose weight in the pixel is below W in "
                    "every channel (default the scene's min_weight; 0 traces all)")
        ->check(share())
        ->type_name("W");
}

void add_sampling_options(CLI::App& command, SamplingArguments& arguments)
{
    command
        .add_option("--spp", arguments.samples,
                    "Samples a pixel (default 1, at the scene's pixel_sample; 16 with --adaptive)")
        ->check(whole_number(1, most_samples))
        ->type_name("N");
    command
        .add_option("--adaptive", arguments.adaptive,
                    "Take N samples only in pixels that differ by more than T from a neighbour")
        ->check(non_negative_number())
        ->type_name("T");
}

void add_threads_option(CLI::App& command, int& threads)
{
    command.add_option("--threads", threads, "Threads (default one a processor)")
        ->check(whole_number(1, most_threads))
        ->type_name("N");
}

void add_threshold_option(CLI::App& command, double& threshold)
{
    add_fraction_option(
        command, "--threshold", threshold,
        "Error above which a pixel counts as off, a number or a fraction N/M (default 1/255)")
        ->check(non_negative_fraction())
        ->type_name("T");
}

void add_kernel_option(CLI::App& command, std::string& kernel)
{
    add_word_option(command, "--kernel", kernel, "packet (default), or the scalar reference",
                    words_of<Kernel>());
}

void add_precision_option(CLI::App& command, std::string& precision, const std::string& meaning)
{
    add_word_option(command, "--precision", precision, meaning, words_of(packet_precisions));
}

void add_kernel_options(CLI::App& command, KernelArguments& arguments)
{
    add_kernel_option(command, arguments.kernel);
    add_word_option(command, "--precision", arguments.precision,
                    "single (default), double, or extended (scalar only)", words_of<Precision>());
    add_traversal_option(command, arguments.traversal);
    add_accuracy_and_self_hits(command, arguments.accuracy);
    command.add_flag("--force-general", arguments.force_general,
                     "Run the general packet kernel, and keep objects and lights that cannot "
                     "be seen; the picture is the same");
    add_isa_and_width(command, arguments.isa);
    add_threads_option(command, arguments.threads);
}

namespace {

/// An option that was given and that only the packet kernel has; empty for none.
std::string packet_option(const KernelArguments& arguments)
{
    return arguments.isa.isa         ? "--isa"
           : arguments.isa.width     ? "--width"
           : arguments.traversal     ? "--traversal"
           : arguments.force_general ? "--force-general"
                                     : "";
}

}  // namespace

Precision chosen_precision(const std::string& word)
{
    return *language::find_word<Precision>(word);
}

IsaInfo chosen_isa(const IsaArguments& arguments)
{
    try {
        return choose_isa(arguments.isa.value_or("auto"), arguments.width.value_or(0));
    } catch (const std::invalid_argument& error) {
        // The message begins with the option or the environment variable.
        const std::string what = error.what();
        throw CLI::ValidationError(what.starts_with("PACKTRACE_ISA") ? what : "--" + what);
    }
}

void apply(const PictureArguments& arguments, Scene& scene)
{
    if (arguments.size) {
        const auto [width, height] = parse_size(*arguments.size).value();
        scene.width = width;
        scene.height = height;
    }
    if (arguments.depth)
        scene.max_depth = *arguments.depth;
    if (arguments.min_weight)
        scene.min_weight = *arguments.min_weight;
}

void apply(const SamplingArguments& arguments, RenderOptions& options)
{
    options.adaptive = arguments.adaptive;
    options.samples = arguments.samples.value_or(arguments.adaptive ? adaptive_samples : 1);
    if (options.adaptive && options.samples == 1)
        throw CLI::ValidationError(
            "--adaptive: needs more than one sample a pixel; leave out "
            "--spp or give it more");
}

void apply(const AccuracyArguments& arguments, const std::string& kernel, Precision precision,
           RenderOptions& options)
{
    if (arguments.accuracy && (kernel == "scalar" || precision != Precision::single))
        throw CLI::ValidationError(
            "--accuracy: only packets of floats have a choice; leave it out or use" +
            std::string(kernel == "scalar" ? " --kernel packet" : "") +
            (precision != Precision::single ? " --precision single" : ""));
    options.accuracy = value_or(arguments.accuracy, options.accuracy);
    options.self_hits = value_or(arguments.self_hits, options.self_hits);
}

RenderOptions render_options(const KernelArguments& arguments)
{
    RenderOptions options{.threads = arguments.threads};
    const Precision precision = chosen_precision(arguments.precision);
    apply(arguments.accuracy, arguments.kernel, precision, options);
    if (arguments.kernel == "scalar") {
        options.kernel = Kernel::scalar;
        if (const std::string option = packet_option(arguments); !option.empty())
            throw CLI::ValidationError(option +
                                       ": only packets have one; leave it out or use "
                                       "--kernel packet");
        return options;
    }
    if (precision == Precision::extended)
        throw CLI::ValidationError(
            "--precision: packets are single or double; extended needs --kernel scalar");
    options.isa = chosen_isa(arguments.isa).name;
    options.traversal = value_or(arguments.traversal, Traversal::automatic);
    options.force_general = arguments.force_general;
    return options;
}

}  // namespace packtrace::cli
