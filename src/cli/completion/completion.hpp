#pragma once

#include "core/text.hpp"

#include <string>
#include <vector>

// What the scripts of all shells are made of.
namespace packtrace::cli {

/// What a shell completes behind an option or as an argument.
enum class Argument {
    none,   ///< a flag has none
    words,  ///< one of a few
    path,   ///< a file or folder
    other   ///< numbers, names: nothing to complete
};

struct OptionWords {
    std::vector<std::string> names;  ///< with their dashes, the short one first
    std::string description;         ///< the help's first sentence
    Argument argument = Argument::none;
    std::vector<std::string> words;  ///< for Argument::words
};

/// A command as a shell completes it: all of the program's words in a tree.
struct CommandWords {
    std::string name;
    std::string description;
    std::vector<OptionWords> options;
    std::vector<CommandWords> commands;
    bool takes_paths = false;  ///< behind no option
};

/// The names of a command's own commands, joined.
[[nodiscard]] std::string inner_names(const CommandWords& command);

// Scripts that teach a shell to complete the program's words.
[[nodiscard]] std::string bash_completion(const CommandWords& program);
[[nodiscard]] std::string zsh_completion(const CommandWords& program);
[[nodiscard]] std::string fish_completion(const CommandWords& program);

}  // namespace packtrace::cli
