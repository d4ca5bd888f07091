#include "core/run_filter.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include "core/read_file.hpp"

extern char** environ;

namespace packtrace {
namespace {

std::atomic<pid_t> running{0};

/// A pipe, of which programs that are started get the one end that they are given.
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

    /// All that is written, until nobody has the other end any more.
    std::string read_all()
    {
        close_end(1);
        std::string text;
        char block[4096];
        for (ssize_t got; (got = read(ends_[0], block, sizeof block)) > 0;)
            text.append(block, static_cast<std::size_t>(got));
        return text;
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

/// The process; 0 if it can't be started.
pid_t start(const std::vector<std::string>& command, int input, int answers, int answers_on)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    // The pipe may have the number that it is asked for on; a copy of itself would be closed again.
    if (answers != answers_on)
        posix_spawn_file_actions_adddup2(&actions, answers, answers_on);
    else
        fcntl(answers, F_SETFD, 0);
    for (const int other : {STDOUT_FILENO, STDERR_FILENO})
        if (other != answers_on)
            posix_spawn_file_actions_addopen(&actions, other, "/dev/null", O_WRONLY, 0);
    std::vector<char*> words;
    for (const std::string& word : command)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_t child = 0;
    const int error = posix_spawnp(&child, words.front(), &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return error == 0 ? child : 0;
}

}  // namespace

FilterResult run_filter(const std::vector<std::string>& command, const std::string& input,
                        int answers_on)
{
    // A file rather than a pipe: who writes it does not wait for its reader.
    const OpenFile in(std::tmpfile());
    Pipe out;
    FilterResult result;
    if (!in || !out.is_open() ||
        std::fwrite(input.data(), 1, input.size(), in.get()) != input.size() ||
        std::fflush(in.get()) != 0)
        return result;
    std::rewind(in.get());
    const pid_t child = start(command, fileno(in.get()), out.writing_end(), answers_on);
    result.started = child != 0;
    if (!result.started)
        return result;
    running.store(child);
    result.output = out.read_all();
    int status = 0;
    waitpid(child, &status, 0);
    running.store(0);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

void end_filter()
{
    const pid_t child = running.load();
    if (child != 0)
        kill(child, SIGTERM);
}

}  // namespace packtrace
