#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "lab/stress/stress.hpp"

namespace packtrace::cli {

/// What `stress` takes, on one machine or many ranks.
struct StressArguments {
    lab::StressOptions options;
    std::optional<std::string> isa;
    std::optional<std::string> traversal;
    std::optional<std::string> cases;  ///< a folder for scenes and rays of wrong answers
    std::optional<std::string> shard;
    int threads = 0;
    bool list = false;
    bool json = false;
};

/// Adds them all but for `--shard`.
void add_stress_options(CLI::App& command, StressArguments& arguments);

/// With the instruction set and the traversal that are named. Throws CLI::ValidationError for those
/// that are none.
[[nodiscard]] lab::StressOptions stress_options(const StressArguments& arguments);

}  // namespace packtrace::cli
