#include "cli/interrupts.hpp"

#include "core/atomic_file.hpp"
#include "core/run_filter.hpp"
#include "scene/language/quote.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <ctime>
#include <string>
#include <string_view>
#include <unistd.h>

namespace packtrace::cli {
namespace {

/// A complete line, with an end of line before and after it, because signal handlers must not
/// allocate.
using SignalLine = std::array<char, 512>;

/// Two lines: one may be read by the handler while the other is written.
std::array<SignalLine, 2> signal_lines;
std::atomic<const char*> given_line{nullptr};
/// The lines if none is given: without and with removed files.
SignalLine usual_line;
SignalLine removal_line;
volatile std::sig_atomic_t linger = 0;  ///< milliseconds

std::string program_name;  ///< at the start of each line

void fill(SignalLine& line, const std::string& given)
{
    // escape() makes one line of it, even if names of files have line ends.
    const std::string text = language::escape(program_name + ": " + given);
    const std::size_t length = std::min(text.size(), line.size() - 3);
    line[0] = '\n';
    std::copy_n(text.data(), length, line.data() + 1);
    line[length + 1] = '\n';
    line[length + 2] = '\0';
}

void say(std::string_view line)
{
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
}

// Calls only functions that signal handlers may call.
void say_and_end(int signal)
{
    // A given line is printed first, because removing files may take some time.
    const char* const given = given_line.load();
    if (given != nullptr)
        say(given);
    end_filter();
    const bool removed = remove_all_temporaries() > 0;
    if (given == nullptr)
        say(removed ? removal_line.data() : usual_line.data());
    end_by_signal(signal, linger);
}

}  // namespace

void handle_ending_signals(void (*handler)(int))
{
    for (const int number : ending_signals) {
        struct sigaction before {};
        if (sigaction(number, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action {};
        action.sa_handler = handler;
        action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
        sigaction(number, &action, nullptr);
    }
}

void end_by_signal(int signal, int milliseconds)
{
    const timespec rest{.tv_sec = milliseconds / 1000, .tv_nsec = milliseconds % 1000 * 1'000'000L};
    nanosleep(&rest, nullptr);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void set_interrupt_line(const std::string& given)
{
    static std::size_t next = 0;
    if (given.empty())
        return given_line.store(nullptr);
    SignalLine& line = signal_lines[next];
    next = 1 - next;
    fill(line, given);
    given_line.store(line.data());
}

void clean_up_when_interrupted(const Interruption& interruption)
{
    program_name = interruption.program;
    linger = interruption.linger_milliseconds;
    const std::string advice = interruption.advice.empty() ? "" : "; " + interruption.advice;
    fill(usual_line, "interrupted" + advice);
    fill(removal_line, "interrupted; the unfinished file is removed" + advice);
    handle_ending_signals(say_and_end);
}

void report_size_limits_as_errors()
{
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace packtrace::cli
