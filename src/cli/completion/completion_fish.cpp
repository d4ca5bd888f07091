#include "cli/completion/completion.hpp"

#include <sstream>

namespace packtrace::cli {
namespace {

std::string fish_quoted(const std::string& text)
{
    std::string result = "'";
    for (const char c : text)
        result += (c == '\'' || c == '\\' ? std::string("\\") : std::string()) + c;
    return result + "'";
}

void write_fish_option(std::ostream& out, const OptionWords& option, const std::string& start)
{
    out << start;
    for (const std::string& name : option.names)
        out << (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
    if (option.argument == Argument::path)
        out << " -r -F";
    else if (option.argument == Argument::other)
        out << " -x";
    else if (option.argument == Argument::words)
        out << " -x -a " << fish_quoted(joined(option.words, " "));
    out << " -d " << fish_quoted(option.description) << '\n';
}

/// `condition` is true if the commands of the line lead to this one.
void write_fish_command(std::ostream& out, const CommandWords& command,
                        const std::string& condition)
{
    std::string here = condition;
    if (!command.commands.empty())
        here += (here.empty() ? "" : "; and ") +
                ("not __fish_seen_subcommand_from " + inner_names(command));
    const std::string start = "complete -c packtrace -n " + fish_quoted(here);
    for (const CommandWords& inner : command.commands)
        out << start << " -a " << inner.name << " -d " << fish_quoted(inner.description) << '\n';
    for (const OptionWords& option : command.options)
        write_fish_option(out, option, start);
    if (command.takes_paths)
        out << start << " -F\n";
    for (const CommandWords& inner : command.commands)
        write_fish_command(out, inner,
                           condition + (condition.empty() ? "" : "; and ") +
                               "__fish_seen_subcommand_from " + inner.name);
}

}  // namespace

std::string fish_completion(const CommandWords& program)
{
    std::ostringstream out;
    out << "# Completion of packtrace for fish, made by: packtrace completion fish\n"
           "complete -c packtrace -f\n";
    write_fish_command(out, program, "");
    return out.str();
}

}  // namespace packtrace::cli
