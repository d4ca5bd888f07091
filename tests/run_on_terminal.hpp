#pragma once

#include <cerrno>
#include <pty.h>
#include <string>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace packtrace::test {

/// Runs the packtrace program on a pseudo-terminal and returns its output. Throws std::system_error
/// if no terminal can be opened.
[[nodiscard]] inline std::string run_on_terminal(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), PACKTRACE_CLI);
    std::vector<char*> words;
    for (std::string& argument : arguments)
        words.push_back(argument.data());
    words.push_back(nullptr);

    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == -1)
        throw std::system_error(errno, std::generic_category(), "forkpty");
    if (child == 0) {
        execv(words[0], words.data());
        _exit(127);
    }
    // Reading fails when the child has closed its end.
    std::string output;
    char buffer[4096];
    for (ssize_t count = 0; (count = read(terminal, buffer, sizeof buffer)) > 0;)
        output.append(buffer, static_cast<std::size_t>(count));
    waitpid(child, nullptr, 0);
    close(terminal);
    return output;
}

}  // namespace packtrace::test
