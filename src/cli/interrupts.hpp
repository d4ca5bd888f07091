#pragma once

#include <array>
#include <csignal>
#include <string>

namespace packtrace::cli {

/// The signals of Ctrl-C, `kill`, a closed terminal and Ctrl-\.
inline constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP, SIGQUIT};

/// Installs a handler of the ending signals. It is called once for each signal; the second signal
/// of a kind ends the program at once. Signals that are already ignored, as under nohup or in a
/// shell's background, stay ignored.
void handle_ending_signals(void (*handler)(int));

/// For such a handler: sleeps for `milliseconds`, then ends the program with the signal.
void end_by_signal(int signal, int milliseconds);

/// The message and the delay of a program that a signal ends.
struct Interruption {
    std::string program = "packtrace";  ///< the name before the message
    std::string advice;                 ///< for the user, after the usual message
    int linger_milliseconds = 0;        ///< from the message to the end
};

/// From now on Ctrl-C, SIGTERM, SIGHUP and SIGQUIT end started programs, remove unfinished files
/// and print one line. Then the program ends with the signal (exit codes 130, 143, 129 and 131 in a
/// shell; after SIGQUIT the system may write a core file).
void clean_up_when_interrupted(const Interruption& interruption = {});

/// From now on a file that exceeds the limit of `ulimit -f` is a write error, like a full disk. By
/// default it ends the program, and unfinished files remain.
void report_size_limits_as_errors();

/// Sets the message of an interrupted program, after the program's name. Empty restores the usual
/// message. Not thread-safe.
void set_interrupt_line(const std::string& line);

}  // namespace packtrace::cli
