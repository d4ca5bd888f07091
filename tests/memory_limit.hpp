#pragma once

#include "run_program.hpp"

#include <string>

namespace packtrace::test {

/// Shell words before a command that limit the program's address space. Empty where it cannot start
/// at all under such a limit: sanitizers map more than any would leave them.
[[nodiscard]] inline std::string memory_limit(int kilobytes)
{
    const std::string limit = "ulimit -v " + std::to_string(kilobytes) + ";";
    return run_packtrace({"--version"}, limit).exit_code == 0 ? limit : "";
}

}  // namespace packtrace::test
