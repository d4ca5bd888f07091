#pragma once

#include <vector>

namespace packtrace {

/// The value below which the given share of the values lies, between neighbours by a straight
/// line; `share` in [0, 1]. `values` has at least one element, in any order.
[[nodiscard]] double quantile(std::vector<double> values, double share);

[[nodiscard]] inline double median_of(const std::vector<double>& values)
{
    return quantile(values, 0.5);
}

/// The median of a[i] - b[i]: of things measured in turns, what one takes more than the other.
[[nodiscard]] double median_difference(const std::vector<double>& a, const std::vector<double>& b);

/// The width of the middle half of the values, over their median.
[[nodiscard]] inline double relative_spread(const std::vector<double>& values)
{
    return (quantile(values, 0.75) - quantile(values, 0.25)) / median_of(values);
}

}  // namespace packtrace
