#pragma once

#include "fork_child.hpp"
#include "run_program.hpp"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace packtrace::test {

/// Replaces this process by a program.
[[noreturn]] inline void become(const std::vector<std::string>& words)
{
    std::vector<char*> arguments;
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments.front(), arguments.data());
    _exit(127);
}

/// Starts a program and sends it a signal once `when` holds; `when` is called every millisecond.
/// The program may end earlier. Returns waitpid()'s status.
[[nodiscard]] inline int kill_program(const std::vector<std::string>& words, int number,
                                      const std::function<bool()>& when)
{
    const pid_t child = fork_child([&] {
        const int nowhere = open("/dev/null", O_RDWR);
        for (const int handle : {0, 1, 2})
            dup2(nowhere, handle);
        become(words);
    });
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (when()) {
            kill(child, number);
            waitpid(child, &status, 0);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return status;
}

/// The standard error of a packtrace command whose work takes many seconds, interrupted after two
/// seconds.
[[nodiscard]] inline std::string interrupted_message(const std::string& command)
{
    const TempFolder folder;
    const std::string words = "exec " + shell_quoted(PACKTRACE_CLI) + " " + command + " 2>" +
                              shell_quoted((folder / "err").string());
    int waits = 0;
    const int status = kill_program({"sh", "-c", words}, SIGINT, [&] { return ++waits > 2000; });
    return WIFSIGNALED(status) ? read_text(folder / "err") : "was not interrupted";
}

/// The number of lines of a file, which need not exist.
[[nodiscard]] inline long lines_of(const std::filesystem::path& file)
{
    const std::string text = read_text(file);
    return std::count(text.begin(), text.end(), '\n');
}

}  // namespace packtrace::test
