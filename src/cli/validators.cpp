#include "cli/validators.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace packtrace::cli {
namespace {

// The number that all of `text` is, if it is one.
template <class Number>
std::optional<Number> parse(const std::string& text)
{
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end)
        return std::nullopt;
    return value;
}

}  // namespace

CLI::Validator non_negative_number()
{
    return CLI::Validator(
        [](std::string& text) -> std::string {
            const std::optional<double> value = parse<double>(text);
            if (value && std::isfinite(*value) && *value >= 0.0)
                return {};
            return "'" + text + "' is not a number from 0 up";
        },
        "NUMBER>=0");
}

CLI::Validator positive_number()
{
    return CLI::Validator(
        [](std::string& text) -> std::string {
            const std::optional<double> value = parse<double>(text);
            if (value && std::isfinite(*value) && *value > 0.0)
                return {};
            return "'" + text + "' is not a number above 0";
        },
        "NUMBER>0");
}

CLI::Validator whole_number(int least, int most)
{
    const std::string range = std::to_string(least) + ".." + std::to_string(most);
    return CLI::Validator(
        [least, most, range](std::string& text) -> std::string {
            const std::optional<int> value = parse<int>(text);
            if (value && *value >= least && *value <= most)
                return {};
            return "'" + text + "' is not a whole number in " + range;
        },
        range);
}

}  // namespace packtrace::cli
