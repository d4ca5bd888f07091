#include "study/stress_bounds.hpp"

namespace packtrace::study {

std::vector<std::string> broken_bounds(const StressRow& row)
{
    std::vector<std::string> broken;
    const auto hold = [&](bool holds, const char* bound) {
        if (!holds)
            broken.emplace_back(bound);
    };
    if (row.kernel != "packet")
        return broken;
    hold(row.wrong == 0, "no wrong hit or miss outside the band");
    hold(row.not_finite == 0, "no hit without a finite t and normal");
    hold(row.rho <= 4.0, "t within 4 times what its inputs' rounding makes");
    if (row.precision == "double")
        hold(row.relative <= 1e-12, "t within 1e-12 where the condition is below 1000");
    return broken;
}

}  // namespace packtrace::study
