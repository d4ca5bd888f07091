#include <packtrace/compare.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "image/pixel_error.hpp"

namespace packtrace {
namespace {

template <class Real>
ErrorReal<Real> squared_error(const Real* a, const Real* b)
{
    ErrorReal<Real> sum = 0;
    for (int c = 0; c < 3; ++c) {
        const ErrorReal<Real> error = channel_error(a[c], b[c]);
        sum += error * error;
    }
    return sum;
}

double psnr_of(double rmse)
{
    return rmse > 0.0 ? -20.0 * std::log10(rmse) : std::numeric_limits<double>::infinity();
}

// Keeps the `count` largest errors, largest first, then in reading order.
void keep_worst(std::vector<PixelError>& errors, int count)
{
    const auto kept = std::min(errors.size(), static_cast<std::size_t>(std::max(count, 0)));
    const auto worse = [](const PixelError& a, const PixelError& b) {
        if (a.error != b.error)
            return a.error > b.error;
        return a.y != b.y ? a.y < b.y : a.x < b.x;
    };
    std::partial_sort(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(kept),
                      errors.end(), worse);
    errors.resize(kept);
}

}  // namespace

void check_same_size(int a_width, int a_height, int b_width, int b_height)
{
    if (a_width == b_width && a_height == b_height)
        return;
    const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h); };
    throw std::invalid_argument("pictures of different size: " + size(a_width, a_height) + " and " +
                                size(b_width, b_height));
}

template <class Real>
Comparison compare(const Image<Real>& a, const Image<Real>& b, const CompareOptions& options)
{
    check_same_size(a.width, a.height, b.width, b.height);
    Comparison result;
    result.pixels = a.rgb.size() / 3;
    // Sums by rows first, so that small errors are not lost beside a large total.
    ErrorReal<Real> sum = 0;
    for (int y = 0; y < a.height; ++y) {
        ErrorReal<Real> row_sum = 0;
        for (int x = 0; x < a.width; ++x) {
            const Real* pa = a.pixel(x, y);
            const Real* pb = b.pixel(x, y);
            const auto error = static_cast<double>(pixel_error(pa, pb));
            row_sum += squared_error(pa, pb);
            result.pixels_off += error > options.threshold;
            if (error > 0.0)
                result.worst.push_back({x, y, error});
        }
        sum += row_sum;
    }
    if (result.pixels > 0)
        result.rmse =
            static_cast<double>(std::sqrt(sum / (3 * static_cast<ErrorReal<Real>>(result.pixels))));
    result.psnr = psnr_of(result.rmse);
    for (const PixelError& pixel : result.worst)
        result.max_abs = std::max(result.max_abs, pixel.error);
    keep_worst(result.worst, options.worst);
    return result;
}

template Comparison compare(const Image<float>&, const Image<float>&, const CompareOptions&);
template Comparison compare(const Image<double>&, const Image<double>&, const CompareOptions&);
template Comparison compare(const Image<long double>&, const Image<long double>&,
                            const CompareOptions&);

}  // namespace packtrace
