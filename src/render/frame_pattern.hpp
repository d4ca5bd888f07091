#pragma once

#include <string>
#include <string_view>

namespace packtrace {

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
