#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace packtrace::bench {

/// A program's name, without the folder, and what it was called with.
[[nodiscard]] std::string command_line(const std::string& program, int argc,
                                       const char* const* argv);

/// Parses a program's arguments and does its work; returns what it exits with: 2 for arguments that
/// are wrong, 1 where the work throws, which is printed behind the program's name.
[[nodiscard]] int run_program(CLI::App& app, const std::string& program, int argc, char** argv,
                              const std::function<void()>& work);

}  // namespace packtrace::bench
