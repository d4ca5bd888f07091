#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace packtrace::bench {

/// What a measurement depends on besides the code it names: machine, compiler, flags of the
/// kernels, the commit that was built, and the machine's load when the program started.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> context();

/// The same as an object, by its names.
[[nodiscard]] nlohmann::ordered_json context_json();

/// Adds the machine's load now to a context, at the end of a measurement.
void add_load_after(nlohmann::ordered_json& context);

/// A program's name, without the folder, and what it was called with.
[[nodiscard]] std::string command_line(const std::string& program, int argc,
                                       const char* const* argv);

/// Parses a program's arguments and does its work; returns what it exits with: 2 for arguments that
/// are wrong, 1 where the work throws, which is printed behind the program's name.
[[nodiscard]] int run_program(CLI::App& app, const std::string& program, int argc, char** argv,
                              const std::function<void()>& work);

}  // namespace packtrace::bench
