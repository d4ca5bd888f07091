#pragma once

#include "cli/options/validators.hpp"
#include "core/text.hpp"
#include "render/option_words.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace packtrace::cli {

/// Adds an option that takes one of a few words.
template <class Argument>
CLI::Option* add_word_option(CLI::App& command, const std::string& name, Argument& argument,
                             const std::string& meaning, const std::vector<std::string>& words)
{
    return command.add_option(name, argument, meaning)
        ->check(one_of(words))
        ->type_name(joined(words, "|"));
}

/// Adds an option that takes a number or a fraction N/M. The caller adds a validator for its range.
template <class Argument>
CLI::Option* add_fraction_option(CLI::App& command, const std::string& name, Argument& argument,
                                 const std::string& meaning)
{
    return command.add_option_function<std::string>(
        name, [&argument](const std::string& text) { argument = parse_fraction(text).value(); },
        meaning);
}

/// The words of an enumeration, for an option that takes one of them.
template <class Enum>
[[nodiscard]] std::vector<std::string> words_of()
{
    std::vector<std::string> words;
    for (const language::Spelling<Enum>& spelling : spellings(Enum{}))
        words.emplace_back(spelling.word);
    return words;
}

/// The words of some values.
template <class Enum, std::size_t count>
[[nodiscard]] std::vector<std::string> words_of(const std::array<Enum, count>& values)
{
    std::vector<std::string> words;
    for (const Enum value : values)
        words.emplace_back(language::word_of(value));
    return words;
}

/// The value of such an option; `usual` if it was not given.
template <class Enum>
[[nodiscard]] Enum value_or(const std::optional<std::string>& word, Enum usual)
{
    return word ? *language::find_word<Enum>(*word) : usual;
}

/// `--isa` and `--width`.
struct IsaArguments {
    std::optional<std::string> isa;
    std::optional<int> width;
};

/// The picture to render: `--size`, `--depth` and `--min-weight`.
struct PictureArguments {
    std::optional<std::string> size;
    std::optional<int> depth;
    std::optional<double> min_weight;
};

/// The exactness of hits: `--accuracy` and `--self-hits`.
struct AccuracyArguments {
    std::optional<std::string> accuracy;
    std::optional<std::string> self_hits;
};

/// How to render: `--kernel`, `--precision`, `--traversal`, `--force-general`, `--threads`, and the
/// options of AccuracyArguments and IsaArguments.
struct KernelArguments {
    std::string kernel = "packet";
    std::optional<std::string> traversal;
    std::string precision = "single";
    AccuracyArguments accuracy;
    bool force_general = false;
    IsaArguments isa;
    int threads = 0;
};

/// The samples per pixel: `--spp` and `--adaptive`.
struct SamplingArguments {
    std::optional<int> samples;
    std::optional<double> adaptive;
};

void add_accuracy_option(CLI::App& command, AccuracyArguments& arguments);
/// `--accuracy` and `--self-hits`, for commands that trace secondary rays.
void add_accuracy_and_self_hits(CLI::App& command, AccuracyArguments& arguments);
void add_traversal_option(CLI::App& command, std::optional<std::string>& traversal);
/// `--kernel`: packet or scalar.
void add_kernel_option(CLI::App& command, std::string& kernel);
/// `--precision`: single or double.
void add_precision_option(CLI::App& command, std::string& precision, const std::string& meaning);
void add_sampling_options(CLI::App& command, SamplingArguments& arguments);
/// `--isa` only, for chosen_isa().
void add_isa_option(CLI::App& command, std::optional<std::string>& isa, const std::string& meaning);
/// `--isa` and `--width`.
void add_isa_and_width(CLI::App& command, IsaArguments& arguments);
/// `--size` only.
void add_size_option(CLI::App& command, PictureArguments& arguments);
void add_picture_options(CLI::App& command, PictureArguments& arguments);
void add_kernel_options(CLI::App& command, KernelArguments& arguments);
void add_threads_option(CLI::App& command, int& threads);
/// `--threshold`: the largest difference of pixels that does not count as off.
void add_threshold_option(CLI::App& command, double& threshold);

/// The value of a word of `--precision`.
[[nodiscard]] Precision chosen_precision(const std::string& word);

/// The instruction set of the options. Throws CLI::ValidationError if it is unknown or this machine
/// does not support it.
[[nodiscard]] IsaInfo chosen_isa(const IsaArguments& arguments);

/// Sets the scene's size, depth and minimum weight, if they were given.
void apply(const PictureArguments& arguments, Scene& scene);

/// Sets the sampling in the render options. Throws CLI::ValidationError for `--adaptive` with one
/// sample.
void apply(const SamplingArguments& arguments, RenderOptions& options);

/// Sets the accuracy in the render options. Throws CLI::ValidationError if there is no choice of
/// accuracy: for kernels other than packets, and for precisions other than single.
void apply(const AccuracyArguments& arguments, const std::string& kernel, Precision precision,
           RenderOptions& options);

/// The render options. Throws CLI::ValidationError for options that contradict each other.
[[nodiscard]] RenderOptions render_options(const KernelArguments& arguments);

}  // namespace packtrace::cli
