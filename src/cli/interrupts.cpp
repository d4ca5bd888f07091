#include "cli/interrupts.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <ctime>
#include <string_view>

#include <unistd.h>

#include "core/atomic_file.hpp"
#include "scene/language/quote.hpp"

namespace packtrace::cli {
namespace {

/// Lines for the handler of signals: one that may be read, one that may be written.
std::array<std::array<char, 512>, 2> signal_lines;
std::atomic<const char*> given_line{nullptr};
volatile std::sig_atomic_t linger = 0;  ///< milliseconds

void say(std::string_view line)
{
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
}

// Calls nothing but what signal handlers may call.
void end_by(int signal)
{
    // A line that is ready goes first: files may take a while.
    const char* const given = given_line.load();
    if (given != nullptr)
        say(given);
    const bool removed = remove_all_temporaries() > 0;
    if (given == nullptr)
        say(removed ? "\npacktrace: interrupted; the unfinished file is removed\n"
                    : "\npacktrace: interrupted\n");
    const timespec rest{.tv_sec = linger / 1000, .tv_nsec = linger % 1000 * 1'000'000L};
    nanosleep(&rest, nullptr);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

}  // namespace

void set_interrupt_line(const std::string& given)
{
    static std::size_t next = 0;
    if (given.empty())
        return given_line.store(nullptr);
    // One line, whatever is in the names of files.
    const std::string line = language::escape(given);
    std::array<char, 512>& text = signal_lines[next];
    next = 1 - next;
    const std::size_t length = std::min(line.size(), text.size() - 3);
    text[0] = '\n';
    std::copy_n(line.data(), length, text.data() + 1);
    text[length + 1] = '\n';
    text[length + 2] = '\0';
    given_line.store(text.data());
}

void clean_up_when_interrupted(int linger_milliseconds)
{
    linger = linger_milliseconds;
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        // What nohup or a shell's background has switched off stays so.
        if (sigaction(number, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action {};
        action.sa_handler = end_by;
        action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
        sigaction(number, &action, nullptr);
    }
}

void report_size_limits_as_errors()
{
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace packtrace::cli
