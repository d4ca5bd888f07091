#pragma once

#include <packtrace/export.hpp>
#include <packtrace/unset_allocator.hpp>

#include <cstddef>
#include <stdexcept>  // for those who catch what is thrown
#include <vector>

namespace packtrace {
namespace detail {

// Throw std::invalid_argument, in the library, as headers have to compile where exceptions are off.
[[noreturn]] PACKTRACE_API void refuse_sides(int width, int height);
[[noreturn]] PACKTRACE_API void refuse_values(std::size_t values, int width, int height);

}  // namespace detail

/// A picture of linear RGB values, 1.0 for full, not clamped; rows from the top, pixels
/// interleaved as r, g, b.
template <class Real>
struct Image {
    using Pixels = std::vector<Real, UnsetAllocator<Real>>;

    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
    Pixels rgb;

    Image() = default;
    /// Black. Throws std::invalid_argument for sides below 0, as unset() does.
    Image(int w, int h) : Image(unset(w, h))
    {
        rgb.assign(rgb.size(), Real(0));
    }

    /// Pixels of any colour, for who fills them all.
    [[nodiscard]] static Image unset(int w, int h)
    {
        if (w < 0 || h < 0)
            detail::refuse_sides(w, h);
        Image image;
        image.width = w;
        image.height = h;
        image.rgb.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3);
        return image;
    }

    /// Whether `rgb` has three values a pixel.
    [[nodiscard]] bool is_whole() const
    {
        return width >= 0 && height >= 0 && rgb.size() % 3 == 0 &&
               rgb.size() / 3 == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }

    /// Throws std::invalid_argument where it has not.
    void check() const
    {
        if (!is_whole())
            detail::refuse_values(rgb.size(), width, height);
    }

    [[nodiscard]] Real* pixel(int x, int y)
    {
        return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x));
    }
    [[nodiscard]] const Real* pixel(int x, int y) const
    {
        return const_cast<Image*>(this)->pixel(x, y);
    }
};

/// The same picture in another precision. Throws as Image::check() does.
template <class To, class From>
[[nodiscard]] Image<To> convert(const Image<From>& from)
{
    from.check();
    auto to = Image<To>::unset(from.width, from.height);
    for (std::size_t i = 0; i < from.rgb.size(); ++i)
        to.rgb[i] = static_cast<To>(from.rgb[i]);
    return to;
}

}  // namespace packtrace
