#include "core/run_filter.hpp"

#include "core/read_file.hpp"
#include "core/signal_gate.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char** environ;

namespace packtrace {
namespace {

/// The program that run_filter() waits for; 0 for none.
std::atomic<pid_t> running{0};

/// Held from the decision to start a program until `running` is set.
SignalGate starting;

/// A pipe. A started program inherits only the end that it is given.
class Pipe {
public:
    Pipe()
    {
        if (pipe2(ends_, O_CLOEXEC) != 0)
            ends_[0] = ends_[1] = -1;
    }
    ~Pipe()
    {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    [[nodiscard]] bool is_open() const
    {
        return ends_[0] >= 0;
    }
    [[nodiscard]] int writing_end() const
    {
        return ends_[1];
    }

    /// Reads until the other end is closed by all its holders.
    std::string read_all()
    {
        close_end(1);
        std::string text;
        char block[4096];
        for (;;) {
            const ssize_t got = read(ends_[0], block, sizeof block);
            if (got > 0)
                text.append(block, static_cast<std::size_t>(got));
            else if (got == 0 || errno != EINTR)
                return text;
        }
    }

private:
    void close_end(int end)
    {
        if (ends_[end] >= 0)
            close(ends_[end]);
        ends_[end] = -1;
    }

    int ends_[2] = {-1, -1};
};

/// The file actions for a started program's descriptors.
class Descriptors {
public:
    Descriptors(int input, int answers, int answers_on)
    {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
        // The pipe may already have this number. A copy to itself would stay close-on-exec.
        if (answers != answers_on)
            posix_spawn_file_actions_adddup2(&actions_, answers, answers_on);
        else
            fcntl(answers, F_SETFD, 0);
        for (const int other : {STDOUT_FILENO, STDERR_FILENO})
            if (other != answers_on)
                posix_spawn_file_actions_addopen(&actions_, other, "/dev/null", O_WRONLY, 0);
    }
    ~Descriptors()
    {
        posix_spawn_file_actions_destroy(&actions_);
    }
    Descriptors(const Descriptors&) = delete;
    Descriptors& operator=(const Descriptors&) = delete;

    [[nodiscard]] const posix_spawn_file_actions_t* actions() const
    {
        return &actions_;
    }

private:
    posix_spawn_file_actions_t actions_;
};

/// Starts a program and sets `running`. Returns the process; 0 if the program cannot be started.
pid_t start(const std::vector<std::string>& command, const Descriptors& descriptors)
{
    std::vector<char*> words;
    for (const std::string& word : command)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const SignalGate::Passage passage(starting);
    if (passage.is_late())
        return 0;
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setsigmask(&attributes, &passage.blocked_before());
    pid_t child = 0;
    if (posix_spawnp(&child, words.front(), descriptors.actions(), &attributes, words.data(),
                     environ) != 0)
        child = 0;
    posix_spawnattr_destroy(&attributes);
    running.store(child);
    return child;
}

/// Waits for a program's end. Returns -1 if a signal ended it, or if someone else waited for it.
int exit_code_of(pid_t child)
{
    int status = 0;
    pid_t ended = -1;
    do
        ended = waitpid(child, &status, 0);
    while (ended < 0 && errno == EINTR);
    return ended == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

FilterResult run_filter(const std::vector<std::string>& command, const std::string& input,
                        int answers_on)
{
    // A file rather than a pipe, because writing it does not wait for the reader.
    const OpenFile in(std::tmpfile());
    Pipe out;
    FilterResult result;
    if (!in || !out.is_open() ||
        std::fwrite(input.data(), 1, input.size(), in.get()) != input.size() ||
        std::fflush(in.get()) != 0)
        return result;
    std::rewind(in.get());
    const pid_t child =
        start(command, Descriptors(fileno(in.get()), out.writing_end(), answers_on));
    if (child == 0 && starting.is_closed())
        wait_for_the_end();
    result.started = child != 0;
    if (!result.started)
        return result;
    result.output = out.read_all();
    result.exit_code = exit_code_of(child);
    running.store(0);
    return result;
}

void end_filter()
{
    starting.close();
    const pid_t child = running.load();
    if (child != 0)
        kill(child, SIGTERM);
}

}  // namespace packtrace
