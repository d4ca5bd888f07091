#pragma once

#include <packtrace/image.hpp>
#include <packtrace/render.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

// Adaptive sampling: where a picture is not smooth, and the regions that this is decided in.
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

/// The region and the pixels beside it, as far as the picture goes: what contrast looks at.
[[nodiscard]] inline Region with_neighbours(const Region& region, int width, int height)
{
    const int x = std::max(0, region.x - 1);
    const int y = std::max(0, region.y - 1);
    return {x, y, std::min(width, region.x + region.width + 1) - x,
            std::min(height, region.y + region.height + 1) - y};
}

/// Copies a region of an image to one of the region's size.
template <class Real>
void copy_region(const Region& region, const Image<Real>& from, Image<Real>& to)
{
    for (int row = 0; row < region.height; ++row)
        std::copy_n(from.pixel(region.x, region.y + row), 3 * region.width, to.pixel(0, row));
}

}  // namespace packtrace
