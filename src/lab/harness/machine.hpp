#pragma once

#include <string>

namespace packtrace {

/// The processor's name as the operating system has it, or "unknown".
[[nodiscard]] std::string processor_name();

/// The compiler the library was built with.
[[nodiscard]] std::string compiler_name();

/// What git calls the state of the sources the library was built from, or "unknown" where they are
/// gone. Asked now: a name kept from configuring would be out of date.
[[nodiscard]] std::string commit_name();

}  // namespace packtrace
