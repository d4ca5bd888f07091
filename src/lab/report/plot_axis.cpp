#include "lab/report/plot_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace packtrace {
namespace {

constexpr int most_decade_tics = 8;

std::string tic_text(const char* format, double value)
{
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

double power_of_ten(int exponent)
{
    return std::pow(10.0, exponent);
}

}  // namespace

double PlotAxis::pixel(double value) const
{
    return first_pixel +
           (last_pixel - first_pixel) * std::log(std::max(value, low) / low) / std::log(high / low);
}

double PlotAxis::value(double pixel) const
{
    return low * std::pow(high / low, (pixel - first_pixel) / (last_pixel - first_pixel));
}

PlotAxis fine_axis(const std::vector<double>& values)
{
    PlotAxis axis;
    const double least = *std::min_element(values.begin(), values.end());
    const double most = *std::max_element(values.begin(), values.end());
    // A tenth of the way on both sides, and something where there is no way.
    const double room = std::max(1.3, std::pow(most / least, 0.1));
    axis.low = least / room;
    axis.high = most * room;
    const bool wide = axis.high / axis.low > 300.0;
    for (int exponent = static_cast<int>(std::floor(std::log10(axis.low)));
         power_of_ten(exponent) <= axis.high; ++exponent)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * power_of_ten(exponent);
            if (value >= axis.low && value <= axis.high && (digit == 1.0 || !wide))
                axis.tics.push_back({value, tic_text("%g", value)});
        }
    return axis;
}

PlotAxis decade_axis(const std::vector<double>& values)
{
    double least = 1.0;
    double most = 0.0;
    bool has_zero = false;
    for (const double value : values) {
        has_zero = has_zero || value == 0.0;
        if (value > 0.0) {
            least = most > 0.0 ? std::min(least, value) : value;
            most = std::max(most, value);
        }
    }
    if (most == 0.0)
        most = least;
    const int lowest = static_cast<int>(std::floor(std::log10(least) - 0.2));
    const int highest = static_cast<int>(std::ceil(std::log10(most) + 0.2));
    PlotAxis axis;
    axis.low = power_of_ten(has_zero ? lowest - 2 : lowest);
    axis.high = power_of_ten(highest);
    if (has_zero)
        axis.tics.push_back({axis.low, "0"});
    const int step = (highest - lowest) / most_decade_tics + 1;
    for (int exponent = lowest; exponent <= highest; exponent += step)
        axis.tics.push_back({power_of_ten(exponent), tic_text("%.0e", power_of_ten(exponent))});
    return axis;
}

}  // namespace packtrace
