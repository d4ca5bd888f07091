#pragma once

#include <packtrace/export.hpp>
#include <packtrace/unset_allocator.hpp>

#include <cstddef>
#include <stdexcept>  // so that callers can catch the exceptions
#include <vector>

namespace packtrace {
namespace detail {

// Throw std::invalid_argument. They are in the library, so that the headers compile with exceptions
// switched off.
[[noreturn]] PACKTRACE_API void refuse_sides(int width, int height);
[[noreturn]] PACKTRACE_API void refuse_values(std::size_t values, int width, int height);

}  // namespace detail

/// A picture of linear RGB values. 1.0 is full intensity; values are not clamped. Rows run from the
/// top, and each pixel is r, g, b.
template <class Real>
struct Image {
    using Pixels = std::vector<Real, UnsetAllocator<Real>>;

    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
    Pixels rgb;

    Image() = default;
    /// A black picture. Throws std::invalid_argument if a side is negative.
    Image(int w, int h) : Image(unset(w, h))
    {
        rgb.assign(rgb.size(), Real(0));
    }

    /// A picture with uninitialised pixels, for callers that write all of them. Throws
    /// std::invalid_argument if a side is negative.
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

    /// Whether `rgb` has three values per pixel.
    [[nodiscard]] bool is_whole() const
    {
        return width >= 0 && height >= 0 && rgb.size() % 3 == 0 &&
               rgb.size() / 3 == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }

    /// Throws std::invalid_argument unless is_whole().
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

/// Returns the picture in another precision. Throws as Image::check() does.
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
