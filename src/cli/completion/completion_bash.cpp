#include "cli/completion/completion.hpp"

#include <sstream>

namespace packtrace::cli {
namespace {

// The script follows the words of the line to a command, whose path is, say, "packtrace render". If
// the last word is an option with an argument, the option decides the completion, otherwise the
// command does. Bash splits "--option=value" into three words.
constexpr const char* bash_start =
    R"(# Completion of packtrace for bash, made by: packtrace completion bash
_packtrace()
{
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local path=packtrace options= words= paths= i
    if [[ $word == = ]]; then
        word=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case "$path ${COMP_WORDS[i]}" in
)";
constexpr const char* bash_before_options = R"(        esac
    done
    case "$path:$before" in
)";
constexpr const char* bash_before_arguments = R"(    *)
        case $path in
)";
constexpr const char* bash_end = R"(        esac
        if [[ $word == -* || -z $words$paths ]]; then
            words=$options paths=
        fi
        ;;
    esac
    COMPREPLY=()
    [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    if [[ -n $paths ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
}
complete -F _packtrace packtrace
)";

void write_bash_paths(std::ostream& out, const CommandWords& command, const std::string& path)
{
    for (const CommandWords& inner : command.commands) {
        const std::string inner_path = path + ' ' + inner.name;
        out << "        '" << inner_path << "') path='" << inner_path << "' ;;\n";
        write_bash_paths(out, inner, inner_path);
    }
}

void write_bash_options(std::ostream& out, const CommandWords& command, const std::string& path)
{
    for (const OptionWords& option : command.options) {
        if (option.argument == Argument::none)
            continue;
        out << "    '" << path << ':' << joined(option.names, "' | '" + path + ':') << "') ";
        if (option.argument == Argument::words)
            out << "words='" << joined(option.words, " ") << "' ;;\n";
        else
            out << (option.argument == Argument::path ? "paths=1 ;;\n" : ";;\n");
    }
    for (const CommandWords& inner : command.commands)
        write_bash_options(out, inner, path + ' ' + inner.name);
}

void write_bash_arguments(std::ostream& out, const CommandWords& command, const std::string& path)
{
    std::string options;
    for (const OptionWords& option : command.options)
        options += (options.empty() ? "" : " ") + joined(option.names, " ");
    out << "        '" << path << "')\n            options='" << options << "'\n            words='"
        << inner_names(command) << "' paths=" << (command.takes_paths ? "1" : "")
        << "\n            ;;\n";
    for (const CommandWords& inner : command.commands)
        write_bash_arguments(out, inner, path + ' ' + inner.name);
}

}  // namespace

std::string bash_completion(const CommandWords& program)
{
    std::ostringstream out;
    out << bash_start;
    write_bash_paths(out, program, "packtrace");
    out << bash_before_options;
    write_bash_options(out, program, "packtrace");
    out << bash_before_arguments;
    write_bash_arguments(out, program, "packtrace");
    out << bash_end;
    return out.str();
}

}  // namespace packtrace::cli
