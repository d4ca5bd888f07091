#include "image/contrast.hpp"

#include <algorithm>

namespace packtrace {
namespace {

// The minimum and maximum of three rows, with a copy of the first and the last pixel at the ends.
template <class Real>
struct RowRange {
    std::vector<Real> low, high;

    RowRange(const Image<Real>& image, int y)
        : low(static_cast<std::size_t>(image.width + 2) * 3), high(low.size())
    {
        const Real* above = image.pixel(0, std::max(y - 1, 0));
        const Real* row = image.pixel(0, y);
        const Real* below = image.pixel(0, std::min(y + 1, image.height - 1));
        const std::size_t count = low.size() - 6;
        Real* to_low = low.data() + 3;
        Real* to_high = high.data() + 3;
        for (std::size_t i = 0; i < count; ++i) {
            to_low[i] = std::min(std::min(above[i], row[i]), below[i]);
            to_high[i] = std::max(std::max(above[i], row[i]), below[i]);
        }
        for (std::vector<Real>* range : {&low, &high}) {
            std::copy_n(range->begin() + 3, 3, range->begin());
            std::copy_n(range->end() - 6, 3, range->end() - 3);
        }
    }
};

}  // namespace

template <class Real>
void ContrastMap<Real>::mark_row(int y)
{
    const RowRange<Real> range(image_, y);
    const auto width = static_cast<std::size_t>(image_.width);
    const Real* row = image_.pixel(0, y);
    const Real* low = range.low.data();
    const Real* high = range.high.data();
    const Real threshold = threshold_;
    std::vector<std::uint8_t> channels(3 * width);
    for (std::size_t i = 0; i < 3 * width; ++i) {
        const Real least = std::min(std::min(low[i], low[i + 3]), low[i + 6]);
        const Real most = std::max(std::max(high[i], high[i + 3]), high[i + 6]);
        channels[i] =
            static_cast<std::uint8_t>((row[i] - least > threshold) | (most - row[i] > threshold));
    }
    std::uint8_t* marks = marks_.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x)
        marks[x] = channels[3 * x] | channels[3 * x + 1] | channels[3 * x + 2];
}

template class ContrastMap<float>;
template class ContrastMap<double>;
template class ContrastMap<long double>;

}  // namespace packtrace
