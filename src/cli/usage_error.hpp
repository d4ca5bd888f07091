#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace packtrace::cli {

/// The message for a wrong use of the command line, one line without its end: what is wrong, what
/// may have been meant, and which --help has more. `arguments` are those of main().
[[nodiscard]] std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int count,
                                      const char* const* arguments);

/// Requires a subcommand. A mistyped subcommand is not reported as missing.
void ask_for_subcommand(CLI::App& app);

}  // namespace packtrace::cli
