#include "render/frame_range.hpp"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>

namespace packtrace {
namespace {

std::optional<int> whole_number(std::string_view text)
{
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || value < 0)
        return std::nullopt;
    return value;
}

}  // namespace

FrameRange parse_frame_range(std::string_view text)
{
    const std::size_t dots = text.find("..");
    const auto first = whole_number(text.substr(0, dots));
    const auto last =
        dots == std::string_view::npos ? std::nullopt : whole_number(text.substr(dots + 2));
    if (!first || !last)
        throw std::invalid_argument("'" + std::string(text) +
                                    "' is not a range of frames such as 0..119");
    if (*first > *last)
        throw std::invalid_argument("the range " + std::string(text) +
                                    " ends before it begins; write the lower frame first");
    return {*first, *last};
}

void check_frame_range(const FrameRange& range, int frames)
{
    if (range.first < 0 || range.last >= frames)
        throw std::invalid_argument(
            "frames " + std::to_string(range.first) + ".." + std::to_string(range.last) +
            " are not all in the animation, which has 0.." + std::to_string(frames - 1));
}

}  // namespace packtrace
