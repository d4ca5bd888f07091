#pragma once

#include <string_view>

namespace packtrace {

/// Frames of an animation, both ends included.
struct FrameRange {
    int first = 0;
    int last = 0;

    [[nodiscard]] int count() const
    {
        return last - first + 1;
    }
};

/// Reads "A..B". Throws std::invalid_argument when it is something else or A > B.
[[nodiscard]] FrameRange parse_frame_range(std::string_view text);

/// Throws std::invalid_argument when the range leaves 0 … frames - 1.
void check_frame_range(const FrameRange& range, int frames);

}  // namespace packtrace
