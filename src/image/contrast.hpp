#pragma once

#include <cstdint>
#include <vector>

#include <packtrace/image.hpp>

namespace packtrace {

/// Where a picture is not smooth: by pixel, 1 where a channel differs by more than a threshold from
/// that of one of the eight neighbours, else 0.
template <class Real>
class ContrastMap {
public:
    ContrastMap(const Image<Real>& image, double threshold)
        : image_(image), threshold_(static_cast<Real>(threshold)), marks_(image.rgb.size() / 3)
    {
    }

    /// Fills row `y`; rows may be filled from several threads.
    void mark_row(int y);

    [[nodiscard]] bool operator()(int x, int y) const
    {
        return marks_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                      static_cast<std::size_t>(x)] != 0;
    }

private:
    const Image<Real>& image_;
    Real threshold_;
    std::vector<std::uint8_t> marks_;
};

}  // namespace packtrace
