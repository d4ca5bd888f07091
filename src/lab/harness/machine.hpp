#pragma once

#include <string>

namespace packtrace {

/// The processor's name as the operating system has it, or "unknown".
[[nodiscard]] std::string processor_name();

/// The compiler the library was built with.
[[nodiscard]] std::string compiler_name();

/// The commit the library was built of, and the flags of its kernels: see build_stamp.hpp.
[[nodiscard]] std::string commit_name();
[[nodiscard]] std::string flags_name();

/// Programs that ran or waited to run on the machine, on average over the last minute: now, and
/// when this program started. 0 where the system does not say.
[[nodiscard]] double load_now();
[[nodiscard]] double load_at_start();

}  // namespace packtrace
