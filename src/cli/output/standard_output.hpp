#pragma once

// Standard output of a whole program. What a command writes to it goes through Output or std::cout.
namespace packtrace::cli {

/// For programs that open files or connections before they print, to be called first of all. Where
/// standard output is closed (`>&-`), none of those takes its number and gets what is printed.
void hold_standard_output();

/// Passes on what was printed. Throws FileError where part of it is lost, as on a full disk.
void check_standard_output();

}  // namespace packtrace::cli
