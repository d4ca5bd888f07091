#pragma once

namespace packtrace::cli {

/// From now on Ctrl-C, SIGTERM and SIGHUP remove the program's unfinished files and say so in one
/// line; the program then ends by that signal (exit codes 130, 143 and 129 in a shell).
void clean_up_when_interrupted();

}  // namespace packtrace::cli
