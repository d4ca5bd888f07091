#pragma once

#include "core/text.hpp"

#include <string>
#include <vector>

// The data for the completion scripts of all shells.
namespace packtrace::cli {

/// What a shell completes after an option or as an argument.
enum class Argument {
    none,   ///< a flag has no argument
    words,  ///< one of a few words
    path,   ///< a file or folder
    other   ///< numbers and names, which are not completed
};

struct OptionWords {
    std::vector<std::string> names;  ///< with dashes, the short name first
    std::string description;         ///< the first sentence of the help
    Argument argument = Argument::none;
    std::vector<std::string> words;  ///< for Argument::words
};

/// A command with its words for completion. The program's commands form a tree.
struct CommandWords {
    std::string name;
    std::string description;
    std::vector<OptionWords> options;
    std::vector<CommandWords> commands;
    bool takes_paths = false;  ///< positional arguments are paths
};

/// The names of a command's subcommands, joined.
[[nodiscard]] std::string inner_names(const CommandWords& command);

// Completion scripts for the program's words.
[[nodiscard]] std::string bash_completion(const CommandWords& program);
[[nodiscard]] std::string zsh_completion(const CommandWords& program);
[[nodiscard]] std::string fish_completion(const CommandWords& program);

}  // namespace packtrace::cli
