#pragma once

#include <string>
#include <utility>
#include <vector>

namespace packtrace::bench {

/// What a measurement depends on besides the code it names: machine, compiler, flags of the
/// kernels, the commit that was built, and the machine's load when the program started.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> context();

/// The machine's load now, for the end of a measurement.
[[nodiscard]] std::pair<std::string, std::string> load_after();

/// A program's name, without the folder, and what it was called with.
[[nodiscard]] std::string command_line(const std::string& program, int argc,
                                       const char* const* argv);

}  // namespace packtrace::bench
