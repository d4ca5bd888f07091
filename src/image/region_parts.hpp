#pragma once

#include <algorithm>

#include <packtrace/image.hpp>
#include <packtrace/render.hpp>

// Regions of a picture, as rendering asks for them.
namespace packtrace {

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
