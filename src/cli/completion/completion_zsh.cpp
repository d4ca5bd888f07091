#include "cli/completion/completion.hpp"

#include <sstream>

namespace packtrace::cli {
namespace {

/// For use in single quotes. Escapes characters with a meaning for _arguments and _describe.
std::string zsh_quoted(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\'')
            result += "'\\''";
        else if (c == '[' || c == ']' || c == ':' || c == '\\')
            result += std::string("\\") + c;
        else
            result += c;
    }
    return result;
}

std::string zsh_action(const OptionWords& option)
{
    switch (option.argument) {
        case Argument::none:
            return {};
        case Argument::other:
            return ": : ";
        case Argument::path:
            return ":file:_files";
        case Argument::words:
            return ":word:(" + joined(option.words, " ") + ")";
    }
    return {};
}

/// Writes one specification per name. Each name excludes the other.
void write_zsh_option(std::ostream& out, const OptionWords& option)
{
    const std::string names = joined(option.names, " ");
    for (const std::string& name : option.names) {
        const bool takes_equals = name.starts_with("--") && option.argument != Argument::none;
        out << " \\\n                '(" << names << ")" << name << (takes_equals ? "=" : "") << '['
            << zsh_quoted(option.description) << ']' << zsh_action(option) << "'";
    }
}

std::string zsh_function(const std::string& path, const CommandWords& command)
{
    return path + '_' + command.name;
}

/// Writes the function of a command, after those of its subcommands.
void write_zsh_command(std::ostream& out, const CommandWords& command, const std::string& function)
{
    for (const CommandWords& inner : command.commands)
        write_zsh_command(out, inner, zsh_function(function, inner));
    out << function << "() {\n    local curcontext=$curcontext state line\n    _arguments -C";
    for (const OptionWords& option : command.options)
        write_zsh_option(out, option);
    if (!command.commands.empty())
        out << " \\\n                '1: :->command' '*:: :->arguments'";
    else if (command.takes_paths)
        out << " \\\n                '*:file:_files'";
    out << '\n';
    if (!command.commands.empty()) {
        out << "    case $state in\n    command)\n        local -a commands=(\n";
        for (const CommandWords& inner : command.commands)
            out << "            '" << inner.name << ':' << zsh_quoted(inner.description) << "'\n";
        out << "        )\n        _describe command commands\n        ;;\n    arguments)\n"
               "        case $line[1] in\n";
        for (const CommandWords& inner : command.commands)
            out << "        " << inner.name << ") " << zsh_function(function, inner) << " ;;\n";
        out << "        esac\n        ;;\n    esac\n";
    }
    out << "}\n\n";
}

}  // namespace

std::string zsh_completion(const CommandWords& program)
{
    std::ostringstream out;
    out << "#compdef packtrace\n# Completion of packtrace for zsh, made by: packtrace completion "
           "zsh\n\n";
    write_zsh_command(out, program, "_packtrace");
    // The script is either called by compinit, or read by the user's start file.
    out << "if [[ $funcstack[1] == _packtrace ]]; then\n    _packtrace \"$@\"\nelse\n"
           "    compdef _packtrace packtrace\nfi\n";
    return out.str();
}

}  // namespace packtrace::cli
