#include <algorithm>
#include <cmath>

#include <packtrace/compare.hpp>

#include "image/color_ramp.hpp"
#include "image/pixel_error.hpp"

namespace packtrace {
namespace {

constexpr double decades = 6.0;

// Where an error lies between `largest` (1) and six decades below it (0).
double place_of(double error, double largest)
{
    if (error == 0.0)
        return 0.0;
    if (error >= largest)
        return 1.0;
    return std::max(0.0, 1.0 + std::log10(error / largest) / decades);
}

}  // namespace

template <class Real>
Image<float> heatmap(const Image<Real>& a, const Image<Real>& b)
{
    check_same_size(a.width, a.height, b.width, b.height);
    std::vector<double> errors(a.rgb.size() / 3);
    double largest = 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i] = static_cast<double>(pixel_error(&a.rgb[3 * i], &b.rgb[3 * i]));
        // An infinite error is off the scale, not the scale.
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
