#pragma once

#include <string>
#include <string_view>

// Which frames of an animation are meant, and what their files are called.
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

/// A file name with a place for the frame's number: %d, or %0Nd for at least N digits with zeros
/// in front. %% stands for a percent sign.
class FramePattern {
public:
    /// Throws std::invalid_argument when `text` has no such place, two, or another %.
    explicit FramePattern(std::string_view text);

    [[nodiscard]] std::string name(int frame) const;

private:
    /// Reads what follows a % at `at`; returns how much that was.
    std::size_t read_place(std::string_view text, std::size_t at);

    std::string before_;
    std::string after_;
    int digits_ = -1;  ///< -1 until the place was met
};

}  // namespace packtrace
