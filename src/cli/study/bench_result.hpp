#pragma once

#include "cli/study/bench_file.hpp"
#include "cli/study/bench_programs.hpp"
#include "lab/bench/slowdown.hpp"

#include <optional>
#include <string>

namespace packtrace::cli {

/// What was measured, and what it is compared with.
struct BenchResult {
    BenchPairs figures;
    bool paired = false;
    double limit = 0.0;

    /// None for a line that the baseline lacks.
    [[nodiscard]] std::optional<Slowdown> slowdown(const BenchLine& line) const;
    [[nodiscard]] std::optional<Verdict> verdict(const BenchLine& line) const;
    /// A busy spell passes, a regression stays.
    [[nodiscard]] bool is_doubtful(const BenchLine& line) const;
    [[nodiscard]] bool has_doubts() const;
};

/// On standard output, as a table.
void print_bench_lines(const BenchResult& result);

/// Throws std::runtime_error where `baseline` has no line of what was measured, and Failed where a
/// line is slower, or may be.
void end_with_verdict(const BenchResult& result, const std::string& baseline);

}  // namespace packtrace::cli
