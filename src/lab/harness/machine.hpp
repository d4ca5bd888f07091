#pragma once

#include <string>

// The machine and the build that measurements come from.
namespace packtrace {

// The next three are written by each build (cmake/write_build_stamp.cmake).

/// What git called the state of the sources when they were built, "-dirty" at its end where files
/// differed from the commit; "unknown" outside a repository.
extern const char* const built_commit;
/// Digest of every file in src/ and include/, the kernels' sources left out: what the scalar
/// reference and its truths are made of.
extern const char* const built_sources;
/// The flags of the compiler that optimise the kernels, without those of each instruction set.
extern const char* const kernel_flags;

/// The processor's name as the operating system has it, or "unknown".
[[nodiscard]] std::string processor_name();

/// Bytes of memory that this process may take: the machine's, or fewer where `ulimit -v` says so.
[[nodiscard]] double memory_limit();

/// The compiler the library was built with.
[[nodiscard]] std::string compiler_name();

/// Programs that ran or waited to run on the machine, on average over the last minute: now, and
/// when this program started. 0 where the system does not say.
[[nodiscard]] double load_now();
[[nodiscard]] double load_at_start();

}  // namespace packtrace
