#include "image/png_filter.hpp"

#include <algorithm>

namespace packtrace {
namespace {

// out = a - b, modulo 256
void subtract(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* out)
{
    for (std::size_t i = 0; i < count; ++i)
        out[i] = static_cast<std::uint8_t>(a[i] - b[i]);
}

}  // namespace

void filter_row(PngFilter filter, std::span<const std::uint8_t> row, const std::uint8_t* above,
                std::uint8_t* out)
{
    constexpr std::size_t pixel = 3;
    switch (filter) {
        case PngFilter::none:
            std::copy(row.begin(), row.end(), out);
            break;
        case PngFilter::sub:
            std::copy_n(row.begin(), pixel, out);
            subtract(row.data() + pixel, row.data(), row.size() - pixel, out + pixel);
            break;
        case PngFilter::up:
            subtract(row.data(), above, row.size(), out);
            break;
    }
}

}  // namespace packtrace
