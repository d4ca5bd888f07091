#pragma once

#include <string>
#include <vector>

#include <packtrace/report.hpp>

namespace packtrace {

/// A variant's time over that of the scalar reference in single precision, both on one thread
/// and taken right after each other, so that a slow machine or moment falls on both.
struct BenchLine {
    std::string name;            ///< "four_spheres, packets avx2 single"
    std::vector<double> ratios;  ///< by repetition
    double ratio = 0.0;          ///< their median
    double spread = 0.0;         ///< width of their middle half over the median
    double milliseconds = 0.0;   ///< of a frame, median
};

struct BenchOptions {
    int repetitions = 9;
    std::vector<std::string> isas;  ///< none: all this machine runs
};

/// Every instruction set in both precisions, and the reference in double.
[[nodiscard]] std::vector<BenchLine> run_bench(const ReportScene& scene,
                                               const BenchOptions& options);

/// The lines of that name again, their ratios added to those there are.
void repeat_line(const ReportScene& scene, const BenchOptions& options, BenchLine& line);

/// A line of a baseline: its name and ratio.
struct BaselineLine {
    std::string name;
    double ratio = 0.0;
};

[[nodiscard]] inline double slowdown(const BenchLine& line, const BaselineLine& baseline)
{
    return line.ratio / baseline.ratio - 1.0;
}

}  // namespace packtrace
