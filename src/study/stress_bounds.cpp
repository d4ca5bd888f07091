#include "study/stress_bounds.hpp"

#include <algorithm>

namespace packtrace::study {
namespace {

using Names = std::vector<std::string>;

bool among(const Names& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

const Names powers = {"exponents", "exponent-1", "exponent-10000"};

/// Families whose answers are no single meeting: their rho alone is held to.
const Names trees = {"critical-angle", "mirror-room", "mirror-ball"};

/// What `auto` is there for.
const Names sharp_in_auto = {"quadrics", "clipped",  "capped",   "general",    "needle",
                             "pancake",  "cond-1e4", "mirrored", "far-quadric"};

class Bounds {
public:
    explicit Bounds(const StressRow& row) : row_(row)
    {
    }

    void hold(bool holds, const char* bound)
    {
        if (!holds)
            broken_.emplace_back(bound);
    }

    void of_all()
    {
        hold(row_.wrong == 0, "no wrong hit or miss outside the band");
        hold(row_.not_finite == 0, "no hit without a finite t and normal");
        hold(row_.rho <= 4.0, "t within 4 times what its inputs' rounding makes");
        hold(row_.exact_taken == 0, "with exact self-hits no own start taken for a hit");
        hold(row_.exact_lost == 0, "with exact self-hits no second meeting lost");
    }

    void of_powers()
    {
        const bool precise = row_.precision == "single" && row_.mode == "robust";
        hold(row_.ulp_max <= (precise ? 0.75 : 2.0), "powers within 2 ulp, 0.75 in robust");
    }

    void of_meetings()
    {
        if (row_.precision == "double")
            hold(row_.relative <= 1e-12, "t within 1e-12 where the condition is below 1000");
        if (row_.mode == "auto" && among(sharp_in_auto, row_.family))
            hold(row_.ulp_p99 <= 3.0, "99 of 100 t of quadrics within 3 ulp in auto");
        if (row_.mode != "robust")
            return;
        hold(row_.wrong_in_band == 0, "no wrong hit or miss that double decides");
        hold(row_.ulp_max <= 4.0, "t within 4 ulp");
        hold(row_.ulp_p99 <= 1.6, "99 of 100 t within 1.6 ulp");
        hold(row_.normal <= 1e-7, "normals within 1e-7");
    }

    [[nodiscard]] const std::vector<std::string>& broken() const
    {
        return broken_;
    }

private:
    const StressRow& row_;
    std::vector<std::string> broken_;
};

}  // namespace

std::vector<std::string> broken_bounds(const StressRow& row)
{
    if (row.kernel != "packet")
        return {};
    Bounds bounds(row);
    bounds.of_all();
    if (among(powers, row.family))
        bounds.of_powers();
    else if (!among(trees, row.family))
        bounds.of_meetings();
    return bounds.broken();
}

}  // namespace packtrace::study
