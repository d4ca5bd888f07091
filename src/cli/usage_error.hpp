#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace packtrace::cli {

/// The line, without its end, that a wrong use of the command line is told with: what is wrong,
/// what may have been meant, and whose --help says more. `arguments` are those of main().
[[nodiscard]] std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int count,
                                      const char* const* arguments);

/// Makes one subcommand needed. A mistyped one is not called missing.
void ask_for_subcommand(CLI::App& app);

}  // namespace packtrace::cli
