#include "cli/command.hpp"
#include "cli/completion/completion.hpp"
#include "cli/options/validators.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>

namespace packtrace::cli {
namespace {

// The type names of options whose arguments are paths. Positional arguments have no type name, and
// all of them are paths.
constexpr std::array<std::string_view, 5> path_types{"DIR", "FILE", "FOLDER", "IMAGE", "PROGRAM"};

std::string first_sentence(const std::string& text)
{
    return text.substr(0, std::min(text.find(". "), text.find("; ")));
}

OptionWords option_words(CLI::Option& option)
{
    OptionWords words;
    for (const std::string& name : option.get_snames())
        words.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        words.names.push_back("--" + name);
    words.description = first_sentence(option.get_description());
    const std::string type = option.get_type_name();
    if (option.get_items_expected_max() == 0)
        return words;
    words.argument = Argument::other;
    if (std::find(path_types.begin(), path_types.end(), type) != path_types.end())
        words.argument = Argument::path;
    words.words = offered_words(option);
    if (!words.words.empty())
        words.argument = Argument::words;
    return words;
}

/// The words of `app`. Commands without a group are hidden, as in the help.
CommandWords command_words(CLI::App& app)
{
    CommandWords words;
    words.name = app.get_name();
    words.description = first_sentence(app.get_description());
    for (CLI::Option* option : app.get_options()) {
        if (option->get_positional())
            words.takes_paths = true;
        else
            words.options.push_back(option_words(*option));
    }
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
        if (!command->get_group().empty())
            words.commands.push_back(command_words(*command));
    return words;
}

void print_completion(CLI::App& app, const std::string& shell)
{
    const CommandWords program = command_words(app);
    std::cout << (shell == "bash"  ? bash_completion(program)
                  : shell == "zsh" ? zsh_completion(program)
                                   : fish_completion(program));
}

}  // namespace

std::string inner_names(const CommandWords& command)
{
    return joined(command.commands, " ", [](const CommandWords& inner) { return inner.name; });
}

// Used by the installation, and by users who do not install the program. The help does not show it.
void add_completion(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "completion", "Print the script that makes a shell complete packtrace's words");
    command->group("");
    const auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->check(one_of({"bash", "zsh", "fish"}))
        ->required()
        ->type_name("");
    command->callback([&app, shell] { print_completion(app, *shell); });
}

}  // namespace packtrace::cli
