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
    if (row.mode == "robust") {
        hold(row.wrong_in_band == 0, "no wrong hit or miss that double decides");
        hold(row.ulp_max <= 4.0, "t within 4 ulp");
        hold(row.ulp_p99 <= 1.6, "99 of 100 t within 1.6 ulp");
        hold(row.normal <= 1e-7, "normals within 1e-7");
        hold(100 * (row.exact_taken + row.exact_lost) <= row.secondary,
             "with exact self-hits 1 in 100 secondary rays taken or lost at most");
    }
    return broken;
}

}  // namespace packtrace::study
