#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

// How builds without the laboratory (PACKTRACE_BUILD_STUDY) refuse what it does, in both programs.
namespace packtrace::cli {

/// Why `program` can't do `what`.
[[nodiscard]] inline std::string why_left_out(const std::string& program, const std::string& what)
{
    return program + ": this build leaves out '" + what +
           "'; type ./run build, which builds all commands";
}

/// Adds a command in the place of one that is left out; `refuse` throws.
inline void add_left_out(CLI::App& app, const std::string& name,
                         const std::function<void()>& refuse)
{
    CLI::App* command = app.add_subcommand(name, "(not in this build; ./run build adds it)");
    command->allow_extras();
    command->callback(refuse);
}

}  // namespace packtrace::cli
