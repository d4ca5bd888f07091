#pragma once

#include "run_program.hpp"

#include <string>

namespace packtrace::test {

/// Shell words before a command that limit the program's address space. Empty if the program cannot
/// start under this limit: sanitizers map more address space than any limit leaves.
[[nodiscard]] inline std::string memory_limit(int kilobytes)
{
    const std::string limit = "ulimit -v " + std::to_string(kilobytes) + ";";
    return run_packtrace({"--version"}, limit).exit_code == 0 ? limit : "";
}

}  // namespace packtrace::test
