#pragma once

#include <string>
#include <vector>

namespace packtrace {

struct FilterResult {
    bool started = false;
    int exit_code = -1;  ///< -1 when it was killed
    std::string output;  ///< standard output; standard error is thrown away
};

/// Runs a program found along PATH with `input` as its standard input.
[[nodiscard]] FilterResult run_filter(const std::vector<std::string>& command,
                                      const std::string& input);

}  // namespace packtrace
