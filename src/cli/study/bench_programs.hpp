#pragma once

#include "cli/study/bench_file.hpp"

#include <string>
#include <vector>

namespace packtrace::cli {

/// What two programs measured in pairs: a line's i-th samples of both were taken right after each
/// other.
struct BenchPairs {
    BenchFigures now;     ///< of this program
    BenchFigures before;  ///< of the other, of the same lines as `now`
};

/// Runs `bench` with these words of a command line, this program's and the other's, by turns, each
/// as a process of its own and so in other places in memory. Throws std::runtime_error, in one
/// line, where either fails.
[[nodiscard]] BenchPairs run_in_pairs(const std::string& other,
                                      const std::vector<std::string>& words, int repetitions);

}  // namespace packtrace::cli
