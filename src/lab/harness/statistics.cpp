#include "lab/harness/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace packtrace {
namespace {

// This many standard deviations around the mean of a normal distribution hold `confidence` of it.
constexpr double normal_deviations = 2.5758;
static_assert(confidence == 0.99);

// From the k-th smallest to the k-th largest, counted from 1; none for k = 0.
std::optional<Interval> between_ranks(std::vector<double> values, std::size_t k)
{
    if (k == 0)
        return std::nullopt;
    std::sort(values.begin(), values.end());
    return Interval{values[k - 1], values[values.size() - k]};
}

std::vector<double> all_differences(const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> result;
    for (const double x : a)
        for (const double y : b)
            result.push_back(x - y);
    return result;
}

}  // namespace

double quantile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> result;
    for (std::size_t i = 0; i < a.size(); ++i)
        result.push_back(a[i] - b[i]);
    return result;
}

// A value is below the median with probability 1/2, like heads of a coin: k is the largest number
// for which the probability of fewer than k heads is at most (1 - confidence) / 2.
std::optional<Interval> median_interval(std::vector<double> values)
{
    const std::size_t count = values.size();
    double exactly = std::pow(0.5, static_cast<double>(count));
    double fewer = 0.0;
    std::size_t k = 0;
    while (fewer + exactly <= (1.0 - confidence) / 2.0) {
        fewer += exactly;
        exactly *= static_cast<double>(count - k) / static_cast<double>(k + 1);
        ++k;
    }
    return between_ranks(std::move(values), k);
}

double shift(const std::vector<double>& a, const std::vector<double>& b)
{
    return median_of(all_differences(a, b));
}

std::optional<Interval> shift_interval(const std::vector<double>& a, const std::vector<double>& b)
{
    const auto m = static_cast<double>(a.size());
    const auto n = static_cast<double>(b.size());
    const double k = m * n / 2.0 - normal_deviations * std::sqrt(m * n * (m + n + 1.0) / 12.0);
    return between_ranks(all_differences(a, b), k >= 1.0 ? static_cast<std::size_t>(k) : 0);
}

}  // namespace packtrace
