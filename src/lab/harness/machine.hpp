#pragma once

#include <string>

// The machine and the build with which something was measured.
namespace packtrace {

// Each build writes the next three (cmake/write_build_stamp.cmake).

/// The commit of the sources, with "-dirty" at its end if files differ from it; "unknown" outside a
/// repository.
extern const char* const built_commit;
/// Digest of all files in src/ and include/ but the kernels' sources: the scalar reference and its
/// truths depend on them.
extern const char* const built_sources;
/// The compiler's flags for kernels, without those of each instruction set.
extern const char* const kernel_flags;

/// The processor's name from the operating system, or "unknown".
[[nodiscard]] std::string processor_name();

/// Bytes of memory that this process may use: all of the machine's, or the limit of `ulimit -v`.
[[nodiscard]] double memory_limit();

/// The compiler that built the library.
[[nodiscard]] std::string compiler_name();

/// Average number of programs that ran or waited to run in the last minute: now, and when this
/// program started. 0 if the system does not give it.
[[nodiscard]] double load_now();
[[nodiscard]] double load_at_start();

}  // namespace packtrace
