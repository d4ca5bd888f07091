#pragma once

#include <string>
#include <unistd.h>
#include <vector>

namespace packtrace {

struct FilterResult {
    bool started = false;
    int exit_code = -1;  ///< -1 if it was killed
    std::string output;
};

/// Runs a program from PATH with `input` as its standard input, and returns its output on the
/// descriptor `answers_on`. Other output is discarded.
[[nodiscard]] FilterResult run_filter(const std::vector<std::string>& command,
                                      const std::string& input, int answers_on = STDOUT_FILENO);

/// Ends the program that run_filter() waits for, if any. For signal handlers, because Ctrl-C does
/// not reach started programs.
void end_filter();

}  // namespace packtrace
