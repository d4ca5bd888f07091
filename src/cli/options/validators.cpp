#include "cli/options/validators.hpp"

#include "core/text.hpp"
#include "scene/language/quote.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

namespace packtrace::cli {
namespace {

/// The largest number of names in a suggestion. More would make the message too long.
constexpr std::size_t most_meant = 3;
/// The shortest text that is searched in names. Shorter texts are in many names.
constexpr std::size_t least_part = 3;

/// Accepts finite numbers for which `accepts` is true.
CLI::Validator number(bool (*accepts)(double), std::string wanted)
{
    return validator(
        [accepts](const std::string& text) {
            const std::optional<double> value = parse_number<double>(text);
            return value && std::isfinite(*value) && accepts(*value);
        },
        std::move(wanted));
}

CLI::Validator not_empty(std::string wanted)
{
    return validator([](const std::string& text) { return !text.empty(); }, std::move(wanted));
}

bool contains(const std::vector<std::string>& words, const std::string& text)
{
    return std::find(words.begin(), words.end(), text) != words.end();
}

/// "a, b or c".
std::string either(const std::vector<std::string>& words)
{
    std::string all = words.front();
    for (std::size_t i = 1; i < words.size(); ++i)
        all += (i + 1 < words.size() ? ", " : " or ") + words[i];
    return all;
}

/// The word that was probably meant by `text`, or else a few words that contain it.
std::vector<std::string> meant_words(const std::string& text, const std::vector<std::string>& words)
{
    if (const std::string_view nearest = language::nearest_word(text, words); !nearest.empty())
        return {std::string(nearest)};
    std::vector<std::string> meant;
    for (const std::string& word : words)
        if (text.size() >= least_part && meant.size() < most_meant &&
            word.find(text) != std::string::npos)
            meant.push_back(word);
    return meant;
}

}  // namespace

std::optional<std::vector<int>> parse_numbers(std::string_view text, char separator)
{
    std::vector<int> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        const std::optional<int> number = parse_number<int>(text.substr(begin, end - begin));
        if (!number)
            return std::nullopt;
        numbers.push_back(*number);
        begin = end + 1;
    }
    return numbers;
}

std::optional<double> parse_fraction(std::string_view text)
{
    const std::size_t slash = text.find('/');
    const std::optional<double> above = parse_number<double>(text.substr(0, slash));
    const std::optional<double> below =
        slash == std::string_view::npos ? 1.0 : parse_number<double>(text.substr(slash + 1));
    // Rejects an infinite divisor, which would make any fraction 0.
    if (!above || !below || !(*above >= 0.0) || !(*below > 0.0) || !std::isfinite(*below))
        return std::nullopt;
    const double value = *above / *below;
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

CLI::Validator validator(std::function<bool(const std::string&)> accepts, std::string wanted)
{
    return CLI::Validator(
        [accepts = std::move(accepts), wanted = std::move(wanted)](std::string& text) {
            return accepts(text) ? std::string() : "'" + text + "' is not " + wanted;
        },
        "");
}

CLI::Validator non_negative_number()
{
    return number([](double value) { return value >= 0.0; }, "a number from 0 up");
}

CLI::Validator non_negative_fraction()
{
    return parsed_by(parse_fraction, "a number from 0 up, or a fraction such as 1/255");
}

CLI::Validator positive_fraction()
{
    return validator([](const std::string& text) { return parse_fraction(text) > 0.0; },
                     "a number above 0, or a fraction such as 1/255");
}

CLI::Validator positive_number()
{
    return number([](double value) { return value > 0.0; }, "a number above 0");
}

CLI::Validator share()
{
    return number([](double value) { return value >= 0.0 && value <= 1.0; },
                  "a number from 0 to 1");
}

CLI::Validator whole_number(int least, int most)
{
    const auto accepts = [least, most](const std::string& text) {
        const std::optional<int> value = parse_number<int>(text);
        return value && *value >= least && *value <= most;
    };
    return validator(
        accepts, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

CLI::Validator file_name()
{
    return not_empty("a file's name");
}

CLI::Validator own_file_name()
{
    return validator([](const std::string& text) { return !text.empty() && text != "-"; },
                     "the name of a file of its own");
}

CLI::Validator folder_name()
{
    return not_empty("a folder's name");
}

CLI::Validator one_of(std::vector<std::string> words)
{
    std::string wanted = either(words);
    const std::string name = offers(words).get_name();
    const auto accepts = [words = std::move(words)](const std::string& text) {
        return contains(words, text);
    };
    return validator(accepts, std::move(wanted)).name(name);
}

CLI::Validator one_of_many(std::vector<std::string> words, std::string wanted)
{
    const std::string name = offers(words).get_name();
    const auto fault = [words = std::move(words), wanted = std::move(wanted)](std::string& text) {
        if (contains(words, text))
            return std::string();
        const std::string what = language::quote(text) + " is not " + wanted;
        const std::vector<std::string> meant = meant_words(text, words);
        return meant.empty() ? what : what + "; did you mean " + either(meant) + "?";
    };
    return CLI::Validator(fault, "").name(name);
}

// The words are stored in the validator's name, which CLI11 does not print.
CLI::Validator offers(const std::vector<std::string>& words)
{
    return validator([](const std::string&) { return true; }, "").name(joined(words, " "));
}

std::vector<std::string> offered_words(CLI::Option& option)
{
    try {
        std::istringstream names(option.get_validator(0)->get_name());
        return {std::istream_iterator<std::string>(names), {}};
    } catch (const CLI::OptionNotFound&) {
        return {};  // it has no validator
    }
}

}  // namespace packtrace::cli
