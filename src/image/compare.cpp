// The difference between two pictures, as numbers and as a picture.
#include "core/check_number.hpp"
#include "image/color_ramp.hpp"
#include "image/pixel_error.hpp"
#include <packtrace/compare.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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
    return rmse > 0.0 ? 0.0 - 20.0 * std::log10(rmse) : std::numeric_limits<double>::infinity();
}

bool is_worse(const PixelError& a, const PixelError& b)
{
    if (a.error != b.error)
        return a.error > b.error;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

// Keeps the `count` largest of the errors added.
class WorstPixels {
public:
    explicit WorstPixels(int count) : count_(static_cast<std::size_t>(count))
    {
    }

    void add(const PixelError& pixel)
    {
        if (heap_.size() == count_) {
            if (count_ == 0 || !is_worse(pixel, heap_.front()))
                return;
            std::pop_heap(heap_.begin(), heap_.end(), is_worse);
            heap_.pop_back();
        }
        heap_.push_back(pixel);
        std::push_heap(heap_.begin(), heap_.end(), is_worse);
    }

    /// Largest first, then in reading order.
    [[nodiscard]] std::vector<PixelError> sorted() &&
    {
        std::sort_heap(heap_.begin(), heap_.end(), is_worse);
        return std::move(heap_);
    }

private:
    std::size_t count_;
    std::vector<PixelError> heap_;  // the smallest error kept is in front
};

constexpr double decades = 6.0;

// The position of an error on a logarithmic scale: 1 for `largest`, 0 from six decades below it on.
double place_of(double error, double largest)
{
    if (error == 0.0)
        return 0.0;
    if (error >= largest)
        return 1.0;
    return std::max(0.0, 1.0 + std::log10(error / largest) / decades);
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

namespace {

template <class Real>
void check_alike(const Image<Real>& a, const Image<Real>& b)
{
    check_same_size(a.width, a.height, b.width, b.height);
    a.check();
    b.check();
}

}  // namespace

template <class Real>
Comparison compare(const Image<Real>& a, const Image<Real>& b, const CompareOptions& options)
{
    check_alike(a, b);
    check_not_negative("threshold", options.threshold);
    check_not_negative("worst", options.worst);
    WorstPixels worst(options.worst);
    Comparison result;
    result.pixels = a.rgb.size() / 3;
    // Sum each row first, so that small errors are not lost beside a large total.
    ErrorReal<Real> sum = 0;
    for (int y = 0; y < a.height; ++y) {
        ErrorReal<Real> row_sum = 0;
        for (int x = 0; x < a.width; ++x) {
            const Real* pa = a.pixel(x, y);
            const Real* pb = b.pixel(x, y);
            const auto error = static_cast<double>(pixel_error(pa, pb));
            row_sum += squared_error(pa, pb);
            result.pixels_off += error > options.threshold;
            result.max_abs = std::max(result.max_abs, error);
            if (error > 0.0)
                worst.add({x, y, error});
        }
        sum += row_sum;
    }
    if (result.pixels > 0)
        result.rmse =
            static_cast<double>(std::sqrt(sum / (3 * static_cast<ErrorReal<Real>>(result.pixels))));
    result.psnr = psnr_of(result.rmse);
    result.worst = std::move(worst).sorted();
    return result;
}

template Comparison compare(const Image<float>&, const Image<float>&, const CompareOptions&);
template Comparison compare(const Image<double>&, const Image<double>&, const CompareOptions&);
template Comparison compare(const Image<long double>&, const Image<long double>&,
                            const CompareOptions&);

template <class Real>
Image<float> heatmap(const Image<Real>& a, const Image<Real>& b)
{
    check_alike(a, b);
    std::vector<double> errors(a.rgb.size() / 3);
    double largest = 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i] = static_cast<double>(pixel_error(&a.rgb[3 * i], &b.rgb[3 * i]));
        // An infinite error is beyond the scale and does not define it.
        if (std::isfinite(errors[i]))
            largest = std::max(largest, errors[i]);
    }
    Image<float> map(a.width, a.height);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const auto color = color_ramp(place_of(errors[i], largest));
        std::copy(color.begin(), color.end(), &map.rgb[3 * i]);
    }
    return map;
}

template Image<float> heatmap(const Image<float>&, const Image<float>&);
template Image<float> heatmap(const Image<double>&, const Image<double>&);
template Image<float> heatmap(const Image<long double>&, const Image<long double>&);

}  // namespace packtrace
