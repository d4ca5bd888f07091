#pragma once

#include <string>

namespace packtrace::cli {

/// From now on Ctrl-C, SIGTERM and SIGHUP remove the program's unfinished files and say so in one
/// line; the program then ends by that signal (exit codes 130, 143 and 129 in a shell), after so
/// many milliseconds.
void clean_up_when_interrupted(int linger_milliseconds = 0);

/// From now on a file that would outgrow the limit of `ulimit -f` is an error of the write, as a full
/// disk is. By default it ends the program, which leaves its unfinished files.
void report_size_limits_as_errors();

/// The line that such an end is told with from now on, in place of the usual one; empty for that.
/// For one thread at a time.
void set_interrupt_line(const std::string& line);

}  // namespace packtrace::cli
