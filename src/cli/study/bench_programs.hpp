#pragma once

#include "cli/study/bench_file.hpp"

#include <string>
#include <vector>

namespace packtrace::cli {

/// The figures of two programs, measured in pairs: the i-th samples of a line were taken right
/// after each other.
struct BenchPairs {
    BenchFigures now;     ///< of this program
    BenchFigures before;  ///< of the other program, with the lines of `now`
};

/// Runs `bench` of this program and of the other in turns, with the given command line. Each run is
/// a separate process, so that the layout in memory varies. Throws std::runtime_error, with one
/// line, if one of them fails.
[[nodiscard]] BenchPairs run_in_pairs(const std::string& other,
                                      const std::vector<std::string>& words, int repetitions);

}  // namespace packtrace::cli
