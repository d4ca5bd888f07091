#pragma once

#include <string>
#include <string_view>

// Ranges of an animation's frames, and the names of their files.
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

/// Reads "A..B". Throws std::invalid_argument for other text and if A > B.
[[nodiscard]] FrameRange parse_frame_range(std::string_view text);

/// Throws std::invalid_argument unless the range is within 0 … frames - 1.
void check_frame_range(const FrameRange& range, int frames);

/// A file name with a placeholder for the frame's number: %d, or %0Nd for at least N digits with
/// leading zeros. %% stands for a percent sign.
class FramePattern {
public:
    /// Throws std::invalid_argument if `text` has no placeholder, two, or another %.
    explicit FramePattern(std::string_view text);

    [[nodiscard]] std::string name(int frame) const;

private:
    /// Reads the text after a %, from `at` on. Returns the number of characters read.
    std::size_t read_place(std::string_view text, std::size_t at);

    std::string before_;
    std::string after_;
    int digits_ = -1;  ///< -1 until the placeholder was read
};

}  // namespace packtrace
