#pragma once

#include <array>
#include <csignal>
#include <string>

namespace packtrace::cli {

/// Ctrl-C, `kill` and the end of a terminal.
inline constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP};

/// Installs a handler of the ending signals. It is called once for each; the second of a kind ends
/// the program at once. A signal that nohup or a shell's background has ignored stays ignored.
void handle_ending_signals(void (*handler)(int));

/// For such a handler: sleeps for some milliseconds, then ends the program by the signal.
void end_by_signal(int signal, int milliseconds);

/// What a program says and does that a signal ends.
struct Interruption {
    std::string program = "packtrace";  ///< before the line that it says
    std::string advice;                 ///< for the user, behind the usual line
    int linger_milliseconds = 0;        ///< from that line to the end
};

/// From now on Ctrl-C, SIGTERM and SIGHUP end what the program has started, remove its unfinished
/// files and say so in one line; the program then ends by that signal (exit codes 130, 143 and 129
/// in a shell).
void clean_up_when_interrupted(const Interruption& interruption = {});

/// From now on a file that would outgrow the limit of `ulimit -f` is an error of the write, as a
/// full disk is. By default it ends the program, which leaves its unfinished files.
void report_size_limits_as_errors();

/// The line that such an end is told with from now on behind the program's name, in place of the
/// usual one; empty for that. For one thread at a time.
void set_interrupt_line(const std::string& line);

}  // namespace packtrace::cli
