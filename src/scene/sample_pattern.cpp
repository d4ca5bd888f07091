#include "scene/sample_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace packtrace {
namespace {

// The bits of `number` mirrored at the binary point.
double radical_inverse(int number)
{
    double inverse = 0.0;
    for (double digit = 0.5; number != 0; number >>= 1, digit *= 0.5)
        inverse += (number & 1) * digit;
    return inverse;
}

double on_grid(double x)
{
    constexpr double steps = 4096.0;
    return std::floor(x * steps + 0.5) / steps;
}

}  // namespace

std::vector<Vec2> sample_pattern(int count)
{
    // In the order of their inverses, so that they share the rows out evenly whatever their count.
    std::vector<int> by_row(static_cast<std::size_t>(count));
    std::iota(by_row.begin(), by_row.end(), 0);
    std::sort(by_row.begin(), by_row.end(),
              [](int a, int b) { return radical_inverse(a) < radical_inverse(b); });
    std::vector<Vec2> pattern(by_row.size());
    for (int row = 0; row < count; ++row) {
        const int column = by_row[static_cast<std::size_t>(row)];
        pattern[static_cast<std::size_t>(column)] = {on_grid((column + 0.5) / count),
                                                     on_grid((row + 0.5) / count)};
    }
    return pattern;
}

}  // namespace packtrace
