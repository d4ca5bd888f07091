#pragma once

#include "lab/stress/stress.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

// The arguments and the output of `stress`, on one machine or many ranks.
namespace packtrace::cli {

/// The options as given.
struct StressArguments {
    lab::StressOptions options;
    std::vector<std::string> precisions;
    std::optional<std::string> isa;
    std::optional<std::string> traversal;
    std::optional<std::string> self_hits;
    std::optional<std::string> cases;  ///< a folder for scenes and rays of wrong answers
    std::optional<std::string> shard;
    int threads = 0;
    bool list = false;
    bool json = false;
};

/// Adds all options except `--shard`.
void add_stress_options(CLI::App& command, StressArguments& arguments);

/// The options, with the instruction set and the traversal of the arguments. Throws
/// CLI::ValidationError for unknown ones.
[[nodiscard]] lab::StressOptions stress_options(const StressArguments& arguments);

/// With --list: throws CLI::ValidationError for options that only a trace of rays uses.
void check_list_options(const CLI::App& command, const StressArguments& arguments);

void print_stress_families(const StressArguments& arguments);

/// Prints the rows of a stress test and its verdict, or JSON. Writes the cases if `--cases` is
/// given. Throws FileError.
void print_stress(const StressArguments& arguments, const std::vector<lab::StressRow>& rows);

}  // namespace packtrace::cli
