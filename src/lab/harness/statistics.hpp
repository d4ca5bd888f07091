#pragma once

#include <optional>
#include <vector>

namespace packtrace {

/// The value below which a share of the values lies, interpolated linearly between neighbours;
/// `share` in [0, 1]. `values` has at least one element, in any order.
[[nodiscard]] double quantile(std::vector<double> values, double share);

[[nodiscard]] inline double median_of(const std::vector<double>& values)
{
    return quantile(values, 0.5);
}

/// a[i] - b[i]. Both are of equal length.
[[nodiscard]] std::vector<double> differences(const std::vector<double>& a,
                                              const std::vector<double>& b);

/// The width of the middle half of the values.
[[nodiscard]] inline double middle_half(const std::vector<double>& values)
{
    return quantile(values, 0.75) - quantile(values, 0.25);
}

/// The width of the middle half of the values, over their median.
[[nodiscard]] inline double relative_spread(const std::vector<double>& values)
{
    return middle_half(values) / median_of(values);
}

/// The seconds of all rows.
template <class Row>
[[nodiscard]] double sum_of_seconds(const std::vector<Row>& rows)
{
    double sum = 0.0;
    for (const Row& row : rows)
        sum += row.seconds;
    return sum;
}

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// The probability that an interval holds the true value.
inline constexpr double confidence = 0.99;

/// A confidence interval of the median of any distribution, by samples of it: from the k-th
/// smallest to the k-th largest value. Thompson, On Confidence Ranges for the Median and Other
/// Expectation Distributions for Populations of Unknown Distribution Form, 1936. None for fewer
/// than 8 values.
[[nodiscard]] std::optional<Interval> median_interval(std::vector<double> values);

/// The median of all a[i] - b[j]. Hodges, Lehmann, Estimates of Location Based on Rank Tests, 1963.
[[nodiscard]] double shift(const std::vector<double>& a, const std::vector<double>& b);

/// A confidence interval of the shift from the distribution of `b` to that of `a`: from the k-th
/// smallest to the k-th largest a[i] - b[j]. Lehmann, Nonparametric Confidence Intervals for a
/// Shift Parameter, 1963; k by the normal approximation, which makes intervals of few values wider.
/// None for fewer than about 6 values each.
[[nodiscard]] std::optional<Interval> shift_interval(const std::vector<double>& a,
                                                     const std::vector<double>& b);

}  // namespace packtrace
