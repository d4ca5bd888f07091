#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab/stress/evaluate.hpp"
#include "lab/stress/stress_subject.hpp"

namespace packtrace::lab {

/// What a kernel said, as bare numbers, how wrong that is, and what it took.
struct MeasureRun {
    Errors errors;
    std::vector<double> answers;
    double seconds = 0.0;
};

/// A family whose question is not what a ray meets first. In either precision it is prepared
/// once, with the truth, for what asks one packet kernel after the other.
struct StressMeasure {
    std::string name;
    std::string what;
    using Ask = std::function<MeasureRun(const StressSubject&)>;
    std::function<Ask(const StressOptions&)> in_single;
    std::function<Ask(const StressOptions&)> in_double;
};

/// All of them, in the order they are shown.
[[nodiscard]] std::vector<StressMeasure> stress_measures();

/// Highlights' powers.
[[nodiscard]] std::vector<StressMeasure> power_measures();
/// Total internal reflection.
[[nodiscard]] StressMeasure glass_measure();
/// Deep ray trees.
[[nodiscard]] std::vector<StressMeasure> tree_measures();

}  // namespace packtrace::lab
