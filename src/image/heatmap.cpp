#include <algorithm>
#include <array>
#include <cmath>

#include <packtrace/compare.hpp>

#include "image/pixel_error.hpp"

namespace packtrace {
namespace {

using Color = std::array<float, 3>;

constexpr double decades = 6.0;
constexpr std::array<Color, 6> stops{Color{0, 0, 0}, Color{0, 0, 1}, Color{0, 1, 0},
                                     Color{1, 1, 0}, Color{1, 0, 0}, Color{1, 1, 1}};

// The colour at `place` in [0, 1] along the stops.
Color ramp(double place)
{
    const double scaled = place * (stops.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(scaled), stops.size() - 2);
    const auto share = static_cast<float>(scaled - static_cast<double>(below));
    Color color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = stops[below][c] + share * (stops[below + 1][c] - stops[below][c]);
    return color;
}

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
        const Color color = ramp(place_of(errors[i], largest));
        std::copy(color.begin(), color.end(), &map.rgb[3 * i]);
    }
    return map;
}

template Image<float> heatmap(const Image<float>&, const Image<float>&);
template Image<float> heatmap(const Image<double>&, const Image<double>&);
template Image<float> heatmap(const Image<long double>&, const Image<long double>&);

}  // namespace packtrace
