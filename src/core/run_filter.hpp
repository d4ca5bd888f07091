#pragma once

#include <string>
#include <unistd.h>
#include <vector>

namespace packtrace {

struct FilterResult {
    bool started = false;
    int exit_code = -1;  ///< -1 when it was killed
    std::string output;
};

/// Runs a program found along PATH with `input` as its standard input, and takes what it writes to
/// its descriptor `answers_on`. What else it says is thrown away.
[[nodiscard]] FilterResult run_filter(const std::vector<std::string>& command,
                                      const std::string& input, int answers_on = STDOUT_FILENO);

/// Ends the program that run_filter() waits for, if any, as Ctrl-C would: for signal handlers, of
/// which programs that were started never hear.
void end_filter();

}  // namespace packtrace
