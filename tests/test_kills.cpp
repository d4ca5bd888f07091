// A program that is ended at any moment leaves only whole files, and nothing temporary after the
// next run.
#include "catch.hpp"
#include "core/atomic_file.hpp"
#include "fork_child.hpp"
#include "killed_program.hpp"
#include "program_works.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace packtrace::test {
namespace {

/// Blocks all signals for this thread.
class BlockedSignals {
public:
    BlockedSignals()
    {
        sigset_t all;
        sigfillset(&all);
        sigprocmask(SIG_SETMASK, &all, &before_);
    }
    ~BlockedSignals()
    {
        restore();
    }
    BlockedSignals(const BlockedSignals&) = delete;
    BlockedSignals& operator=(const BlockedSignals&) = delete;

    void restore() const
    {
        sigprocmask(SIG_SETMASK, &before_, nullptr);
    }

private:
    sigset_t before_{};
};

/// Starts `packtrace` and discards its output.
pid_t start_quietly(std::vector<std::string> words)
{
    words.insert(words.begin(), PACKTRACE_CLI);
    // No signal may reach the forked copy before it has become packtrace: the test framework's
    // handlers would run.
    const BlockedSignals blocked;
    return fork_child([&] {
        for (const int ending : {SIGTERM, SIGINT})
            std::signal(ending, SIG_DFL);
        blocked.restore();
        const int nothing = open("/dev/null", O_RDWR);
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            dup2(nothing, stream);
        become(words);
    });
}

/// Starts the program and ends it by a signal after this time; the program may have ended earlier.
void start_and_end(const Work& work, const TempFolder& folder, int number, int microseconds)
{
    const pid_t process = start_quietly(words_of(work, folder));
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
    kill(process, number);
    int status = 0;
    waitpid(process, &status, 0);
}

void end_at_any_moment(int moments, unsigned seed)
{
    std::mt19937 random(seed);
    for (const Work& work : all_work()) {
        const TempFolder whole;
        write_rays(whole);
        REQUIRE(run_packtrace(words_of(work, whole)).exit_code == 0);
        const std::string expected = read_text(whole / work.output);
        const TempFolder folder;
        write_rays(folder);
        for (int i = 0; i < moments; ++i) {
            const int number = std::array{SIGKILL, SIGTERM, SIGINT}[random() % 3];
            const int moment = static_cast<int>(random() % static_cast<unsigned>(work.longest));
            CAPTURE(work.name, number, moment);
            const std::size_t before = temporaries(folder);
            start_and_end(work, folder, number, moment);
            if (std::filesystem::exists(folder / work.output))
                CHECK(is_whole(work, read_text(folder / work.output), expected));
            CHECK((number == SIGKILL || temporaries(folder) <= before));
        }
        CHECK(run_packtrace(words_of(work, folder)).exit_code == 0);
        CHECK(is_whole(work, read_text(folder / work.output), expected));
        CHECK(temporaries(folder) == 0);
    }
}

/// Creates one file after another until the process ends.
void write_without_end(const std::filesystem::path& target)
{
    while (true) {
        AtomicFile file(target);
        file.write("text");
        file.commit();
    }
}

/// A process with two writers that ends as the signal handler ends it.
[[noreturn]] void write_and_end(const TempFolder& folder, int microseconds)
{
    for (const char* const name : {"a", "b"})
        std::thread(write_without_end, folder / name).detach();
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
    remove_all_temporaries();
    _exit(0);
}

}  // namespace

TEST_CASE("no temporary file appears after a program has cleaned up", "[kills]")
{
    const TempFolder folder;
    for (int i = 0; i < 300; ++i) {
        const pid_t process = fork_child([&] { write_and_end(folder, 100 + 7 * i); });
        int status = 0;
        waitpid(process, &status, 0);
        REQUIRE(status == 0);
        REQUIRE(temporaries(folder) == 0);
    }
}

TEST_CASE("a program ended at any moment leaves whole files or none", "[kills]")
{
    end_at_any_moment(6, 1);
}

TEST_CASE("a program ended at many more moments leaves whole files or none", "[kills][slow]")
{
    end_at_any_moment(40, 2);
}

}  // namespace packtrace::test
