#pragma once

#include <packtrace/image.hpp>
#include <packtrace/render.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

// Adaptive sampling: finds the pixels of a picture that need more samples.
namespace packtrace {

/// Marks the pixels of a picture with contrast: a channel differs by more than a threshold from
/// that of one of the eight neighbours.
template <class Real>
class ContrastMap {
public:
    ContrastMap(const Image<Real>& image, double threshold)
        : image_(image), threshold_(static_cast<Real>(threshold)), marks_(image.rgb.size() / 3)
    {
    }

    /// Computes row `y`. Different rows may be computed on several threads at once.
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

/// The region and its neighbouring pixels inside the picture, which its contrast depends on.
[[nodiscard]] inline Region with_neighbours(const Region& region, int width, int height)
{
    const int x = std::max(0, region.x - 1);
    const int y = std::max(0, region.y - 1);
    return {x, y, std::min(width, region.x + region.width + 1) - x,
            std::min(height, region.y + region.height + 1) - y};
}

/// Copies a region of an image to an image of the region's size.
template <class Real>
void copy_region(const Region& region, const Image<Real>& from, Image<Real>& to)
{
    for (int row = 0; row < region.height; ++row)
        std::copy_n(from.pixel(region.x, region.y + row), 3 * region.width, to.pixel(0, row));
}

}  // namespace packtrace
