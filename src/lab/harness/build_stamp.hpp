#pragma once

namespace packtrace {

// Written by each build (cmake/write_build_stamp.cmake).

/// What git called the state of the sources when they were built, "-dirty" at its end where files
/// differed from the commit; "unknown" outside a repository.
extern const char* const built_commit;
/// Digest of every file in src/ and include/, the kernels' sources left out: what the scalar
/// reference and its truths are made of.
extern const char* const built_sources;
/// The flags of the compiler that optimise the kernels, without those of each instruction set.
extern const char* const kernel_flags;

}  // namespace packtrace
