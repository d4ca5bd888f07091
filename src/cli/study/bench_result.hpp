#pragma once

#include "cli/study/bench_file.hpp"
#include "cli/study/bench_programs.hpp"
#include "lab/bench/slowdown.hpp"

#include <optional>
#include <string>

namespace packtrace::cli {

/// The measurements, and the baseline they are compared with.
struct BenchResult {
    BenchPairs figures;
    bool paired = false;
    double limit = 0.0;

    /// Not set for a line that the baseline does not have.
    [[nodiscard]] std::optional<Slowdown> slowdown(const BenchLine& line) const;
    [[nodiscard]] std::optional<Verdict> verdict(const BenchLine& line) const;
    /// Whether the line should be measured again. A busy machine is temporary, a regression is not.
    [[nodiscard]] bool is_doubtful(const BenchLine& line) const;
    [[nodiscard]] bool has_doubts() const;
};

/// Prints a table on standard output.
void print_bench_lines(const BenchResult& result);

/// Throws std::runtime_error if `baseline` has none of the measured lines, and Failed if a line is
/// slower or may be slower.
void end_with_verdict(const BenchResult& result, const std::string& baseline);

}  // namespace packtrace::cli
