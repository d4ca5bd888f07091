#include "cli/interrupts.hpp"

#include <csignal>
#include <string_view>

#include <unistd.h>

#include "core/atomic_file.hpp"

namespace packtrace::cli {
namespace {

// Calls nothing but what signal handlers may call.
void end_by(int signal)
{
    const std::string_view line = remove_all_temporaries() > 0
                                      ? "\npacktrace: interrupted; the unfinished file is removed\n"
                                      : "\npacktrace: interrupted\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

}  // namespace

void clean_up_when_interrupted()
{
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

}  // namespace packtrace::cli
