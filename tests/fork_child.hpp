#pragma once

#include <cerrno>
#include <system_error>
#include <unistd.h>

namespace packtrace::test {

/// Runs `run` in a forked child and returns the child's process id. `run` either becomes another
/// program or ends the child. If `run` returns or throws, the child ends with exit code 127. Throws
/// std::system_error if fork() fails: kill() would take its -1 for all processes of the user, and
/// waitpid() for any child.
template <class Run>
[[nodiscard]] pid_t fork_child(const Run& run)
{
    const pid_t child = fork();
    if (child < 0)
        throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) {
        // An exception would unwind into the copy of the test framework.
        try {
            run();
        } catch (...) {
        }
        _exit(127);
    }
    return child;
}

}  // namespace packtrace::test
