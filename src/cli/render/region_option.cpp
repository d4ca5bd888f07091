#include "cli/render/region_option.hpp"

#include <array>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "render/check_sampling.hpp"

namespace packtrace::cli {
namespace {

/// Four whole numbers "X,Y,W,H", or nothing.
std::optional<Region> parse_region(std::string_view text)
{
    std::array<int, 4> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto [behind, error] = std::from_chars(at, end, numbers[i]);
        const bool is_last = i + 1 == numbers.size();
        if (error != std::errc() || (is_last ? behind != end : behind == end || *behind != ','))
            return std::nullopt;
        at = behind + 1;
    }
    return Region{numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::string check_region(const std::string& text)
{
    return parse_region(text) ? ""
                              : "'" + text +
                                    "' is not a region such as 100,50,320,240: column and row of "
                                    "its first pixel, width and height";
}

}  // namespace

void add_region_option(CLI::App& command, RenderArguments& arguments)
{
    command
        .add_option("--region", arguments.region,
                    "Render a part of the picture alone: column and row of its first pixel, from "
                    "the upper left, its width and height (default all of it)")
        ->check(CLI::Validator(check_region, ""))
        ->type_name("X,Y,W,H");
}

void check_region_options(const RenderArguments& arguments)
{
    if (!arguments.region)
        return;
    if (arguments.resume)
        throw CLI::ValidationError("--region: can't be resumed; leave out --resume");
    if (arguments.certainty)
        throw CLI::ValidationError("--region: --certainty is of whole pictures; leave one out");
}

std::optional<Region> region_of(const RenderArguments& arguments, const Scene& scene)
{
    if (!arguments.region)
        return std::nullopt;
    RenderOptions options;
    options.region = parse_region(*arguments.region);
    try {
        return checked_region(options, scene);
    } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError(std::string("--") + error.what());
    }
}

}  // namespace packtrace::cli
