#include "cli/usage_error.hpp"

#include "scene/language/quote.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace packtrace::cli {
namespace {

/// The innermost subcommand in use, or the program itself.
const CLI::App& innermost(const CLI::App& app)
{
    const auto used = app.get_subcommands();
    return used.empty() ? app : innermost(*used.front());
}

/// "packtrace generate lattice". For other programs it begins with the name of their file.
std::string full_name(const CLI::App& command)
{
    const CLI::App* const parent = command.get_parent();
    if (parent == nullptr)
        return command.get_name().empty()
                   ? "packtrace"
                   : std::filesystem::path(command.get_name()).filename().string();
    return full_name(*parent) + " " + command.get_name();
}

std::vector<std::string> subcommands_of(const CLI::App& command)
{
    std::vector<std::string> names;
    for (const CLI::App* subcommand : command.get_subcommands({}))
        names.push_back(subcommand->get_name());
    return names;
}

/// The long names of all options that the help shows.
std::vector<std::string> options_of(const CLI::App& command)
{
    std::vector<std::string> names;
    const auto is_shown = [](const CLI::Option* option) { return !option->get_group().empty(); };
    for (const CLI::Option* option : command.get_options(is_shown))
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

/// The words that neither this command nor its parents accepted. A subcommand passes words without
/// a dash to its parent.
std::vector<std::string> unexpected_words(const CLI::App& command)
{
    std::vector<std::string> words = command.remaining();
    if (const CLI::App* const parent = command.get_parent(); parent != nullptr)
        for (const std::string& word : unexpected_words(*parent))
            words.push_back(word);
    return words;
}

/// The unexpected words to blame. An unexpected word after an unknown option may be its value, and
/// may also be the value of a known option. So only options are blamed, if there are any. Before a
/// subcommand no option takes a value. After the mark `--`, which CLI11 lists too, none is an
/// option.
std::vector<std::string> words_to_blame(const CLI::App& command)
{
    std::vector<std::string> words = unexpected_words(command);
    const bool has_mark = std::erase(words, "--") > 0;
    const auto is_option = [](const std::string& word) { return word.starts_with('-'); };
    if (!has_mark && subcommands_of(command).empty() &&
        std::any_of(words.begin(), words.end(), is_option))
        std::erase_if(words, std::not_fn(is_option));
    return words;
}

/// The first word to blame on the command line; empty for none. CLI11 may list them in reverse
/// order.
std::string first_unexpected(const CLI::App& command, int count, const char* const* arguments)
{
    const std::vector<std::string> blamed = words_to_blame(command);
    for (int i = 1; i < count; ++i)
        if (std::find(blamed.begin(), blamed.end(), arguments[i]) != blamed.end())
            return arguments[i];
    return blamed.empty() ? "" : blamed.back();
}

std::string describe_unexpected(const CLI::App& command, const std::string& word)
{
    const std::vector<std::string> subcommands = subcommands_of(command);
    const bool is_option = word.starts_with('-');
    const std::string what = is_option              ? "unknown option "
                             : !subcommands.empty() ? "unknown subcommand "
                                                    : "unexpected argument ";
    const std::vector<std::string> known = is_option ? options_of(command) : subcommands;
    const std::string name = word.substr(0, word.find('='));
    const std::string_view nearest = language::nearest_word(name, known);
    const std::string text = what + language::quote(name);
    return nearest.empty() ? text : text + "; did you mean " + std::string(nearest) + "?";
}

/// Rewrites CLI11's message about a repeated option or a missing value in plain words.
std::string describe_mismatch(const std::string& what)
{
    static constexpr std::string_view repeated = ": At Most 1 required but received ";
    static constexpr std::string_view lacking = ": 1 required ";
    static constexpr std::string_view missing = " missing";
    if (const std::size_t at = what.find(repeated); at != std::string::npos)
        return what.substr(0, at) + ": given " + what.substr(at + repeated.size()) +
               " times; give it once";
    const std::size_t at = what.find(lacking);
    if (at == std::string::npos || !what.ends_with(missing))
        return what;
    const std::size_t begin = at + lacking.size();
    return what.substr(0, at) + ": needs a value, " +
           what.substr(begin, what.size() - missing.size() - begin);
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int count,
                        const char* const* arguments)
{
    const CLI::App& command = innermost(app);
    const std::string name = full_name(command);
    std::string what = dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr
                           ? describe_mismatch(error.what())
                           : error.what();
    // A missing option may be there under a mistyped name, so the unknown name is reported first.
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
        dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
        if (const std::string word = first_unexpected(command, count, arguments); !word.empty())
            what = describe_unexpected(command, word);
    return name + ": " + what + (what.ends_with('?') ? " See " : "; see ") + name + " --help";
}

void ask_for_subcommand(CLI::App& app)
{
    app.require_subcommand(0, 1);
    // Check before the command runs. The check allocates, and after the command a whole picture
    // would still be in memory.
    app.parse_complete_callback([&app] {
        if (app.get_subcommands().empty())
            throw CLI::RequiredError::Subcommand(1);
    });
}

}  // namespace packtrace::cli
