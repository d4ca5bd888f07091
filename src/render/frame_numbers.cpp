#include "render/frame_numbers.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

namespace packtrace {
namespace {

std::optional<int> whole_number(std::string_view text)
{
    const std::optional<int> value = parse_number<int>(text);
    return value && *value >= 0 ? value : std::nullopt;
}

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

[[noreturn]] void refuse(std::string_view text, const std::string& why)
{
    throw std::invalid_argument("'" + std::string(text) + "' " + why +
                                "; write one %d or %04d where the frame's number goes");
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

FramePattern::FramePattern(std::string_view text)
{
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '%')
            at += read_place(text, at + 1);
        else
            (digits_ < 0 ? before_ : after_) += text[at];
    }
    if (digits_ < 0)
        refuse(text, "has no place for the frame's number");
}

std::size_t FramePattern::read_place(std::string_view text, std::size_t at)
{
    if (at < text.size() && text[at] == '%') {
        (digits_ < 0 ? before_ : after_) += '%';
        return 1;
    }
    // Between % and d there is nothing, or a zero and one digit: %04d.
    std::size_t end = at;
    int digits = 1;
    if (at + 1 < text.size() && text[at] == '0' && is_digit(text[at + 1])) {
        digits = std::max(text[at + 1] - '0', 1);
        end = at + 2;
    }
    if (end >= text.size() || text[end] != 'd')
        refuse(text, "has a % that is no %d, %0Nd or %%");
    if (digits_ >= 0)
        refuse(text, "has two places for the frame's number");
    digits_ = digits;
    return end + 1 - at;
}

std::string FramePattern::name(int frame) const
{
    const std::string number = std::to_string(frame);
    const auto digits = static_cast<std::size_t>(digits_);
    const std::size_t zeros = digits > number.size() ? digits - number.size() : 0;
    return before_ + std::string(zeros, '0') + number + after_;
}

}  // namespace packtrace
