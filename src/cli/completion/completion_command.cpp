#include <iostream>
#include <memory>
#include <string>

#include "cli/command.hpp"
#include "cli/completion/command_words.hpp"
#include "cli/options/validators.hpp"

namespace packtrace::cli {
namespace {

void print_completion(const CLI::App& app, const std::string& shell)
{
    const CommandWords program = command_words(app);
    std::cout << (shell == "bash"  ? bash_completion(program)
                  : shell == "zsh" ? zsh_completion(program)
                                   : fish_completion(program));
}

}  // namespace

// For installation, and for those who don't install: hidden from the help.
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
