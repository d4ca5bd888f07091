#pragma once

// Standard output of the whole program. Commands write to it through Output or std::cout.
namespace packtrace::cli {

/// Call it first in a program that opens files or connections before it prints. If standard output
/// is closed (`>&-`), it prevents that one of them gets its descriptor, and so the printed text.
void hold_standard_output();

/// Flushes the printed text. Throws FileError if part of it is lost, as on a full disk.
void check_standard_output();

}  // namespace packtrace::cli
