#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

// Error messages for commands that are missing in builds without PACKTRACE_BUILD_STUDY, for both
// programs.
namespace packtrace::cli {

/// The message that `program` cannot do `what`.
[[nodiscard]] inline std::string why_left_out(const std::string& program, const std::string& what)
{
    return program + ": this build leaves out '" + what +
           "'; type ./run build, which builds all commands";
}

/// Adds a command in place of a missing one. `refuse` must throw.
inline void add_left_out(CLI::App& app, const std::string& name,
                         const std::function<void()>& refuse)
{
    CLI::App* command = app.add_subcommand(name, "(not in this build; ./run build adds it)");
    command->allow_extras();
    command->callback(refuse);
}

}  // namespace packtrace::cli
