#pragma once

#include <optional>
#include <string>

#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

namespace packtrace::cli {

/// `--isa` and `--width`.
struct IsaArguments {
    std::optional<std::string> isa;
    std::optional<int> width;
};

/// What picture to render of a scene: `--size`, `--depth` and `--min-weight`.
struct PictureArguments {
    std::optional<std::string> size;
    std::optional<int> depth;
    std::optional<double> min_weight;
};

/// How exact hits are: `--accuracy` and `--self-hits`.
struct AccuracyArguments {
    std::optional<std::string> accuracy;
    std::optional<std::string> self_hits;
};

/// How to render it: `--kernel`, `--precision`, `--traversal`, `--force-general`, `--threads` and
/// those of AccuracyArguments and IsaArguments.
struct KernelArguments {
    std::string kernel = "packet";
    std::optional<std::string> traversal;
    std::string precision = "single";
    AccuracyArguments accuracy;
    bool force_general = false;
    IsaArguments isa;
    int threads = 0;
};

/// How many samples a pixel gets: `--spp` and `--adaptive`.
struct SamplingArguments {
    std::optional<int> samples;
    std::optional<double> adaptive;
};

void add_accuracy_option(CLI::App& command, AccuracyArguments& arguments);
/// `--accuracy`, and `--self-hits` for what traces secondary rays.
void add_accuracy_options(CLI::App& command, AccuracyArguments& arguments);
void add_traversal_option(CLI::App& command, std::optional<std::string>& traversal);
[[nodiscard]] Traversal traversal_named(const std::string& name);
void add_sampling_options(CLI::App& command, SamplingArguments& arguments);
void add_isa_options(CLI::App& command, IsaArguments& arguments);
/// `--size` alone.
void add_size_option(CLI::App& command, PictureArguments& arguments);
void add_picture_options(CLI::App& command, PictureArguments& arguments);
void add_kernel_options(CLI::App& command, KernelArguments& arguments);
void add_threads_option(CLI::App& command, int& threads);

/// The instruction set asked for. Throws CLI::ValidationError when there is no such one here.
[[nodiscard]] IsaInfo chosen_isa(const IsaArguments& arguments);

/// Puts the size, depth and least weight asked for into the scene.
void apply(const PictureArguments& arguments, Scene& scene);

/// Puts the sampling asked for into the options. Throws CLI::ValidationError for `--adaptive` with
/// one sample.
void apply(const SamplingArguments& arguments, RenderOptions& options);

/// Puts the accuracy asked for into the options. Throws CLI::ValidationError where there is no
/// choice: the kernel is not packets, or the precision not "single".
void apply(const AccuracyArguments& arguments, const std::string& kernel,
           const std::string& precision, RenderOptions& options);

/// Throws CLI::ValidationError for options that contradict each other.
[[nodiscard]] RenderOptions render_options(const KernelArguments& arguments);

}  // namespace packtrace::cli
