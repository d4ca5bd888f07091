#pragma once

#include "lab/harness/report_variants.hpp"
#include "lab/harness/statistics.hpp"
#include <packtrace/report.hpp>

#include <functional>
#include <string>
#include <vector>

namespace packtrace {

/// A variant's time over that of the scalar reference in single precision, both on one thread and
/// measured right after each other, so that a slow machine or moment affects both. Times are
/// processor seconds of this program, without those of other programs.
struct BenchLine {
    std::string name;             ///< "four_spheres, packets avx2 single"
    std::vector<double> ratios;   ///< by repetition
    std::vector<double> seconds;  ///< of a frame, by repetition

    [[nodiscard]] double ratio() const
    {
        return median_of(ratios);
    }
};

/// The lines of a scene: every instruction set in both precisions, and the reference in double.
class SceneBench {
public:
    /// On these instruction sets; for an empty list, on all that this machine has.
    SceneBench(const ReportScene& scene, const std::vector<std::string>& isas);

    /// Measures the wanted lines by turns, so that a busy moment affects all of them. Adds to the
    /// measurements of earlier calls.
    void measure(int repetitions, const std::function<bool(const BenchLine&)>& wanted);

    [[nodiscard]] const std::vector<BenchLine>& lines() const
    {
        return lines_;
    }
    /// The line that all others are compared with.
    [[nodiscard]] const BenchLine& reference() const
    {
        return reference_;
    }

private:
    void measure_once(std::size_t line);

    std::vector<Subject> subjects_;  // the reference, then the lines
    BenchLine reference_;
    std::vector<BenchLine> lines_;
};

}  // namespace packtrace
