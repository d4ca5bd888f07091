// Programs that are ended at any moment leave whole files or none, and nothing after the next run.
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "catch.hpp"
#include "core/atomic_file.hpp"
#include "run_program.hpp"

namespace packtrace::test {
namespace {

/// A run of the program, and the file that it writes.
struct Work {
    std::string name;
    std::string output;
    std::vector<std::string> words;  ///< `@` stands for the folder
    int longest = 60000;             ///< microseconds after which it is ended at the latest
};

const std::string animated = PACKTRACE_SOURCE_DIR "/scenes/flight.scene";

std::vector<Work> all_work()
{
    const std::vector<std::string> small = {"--size", "160x120", "-q"};
    const auto render = [&](std::vector<std::string> words) {
        words.insert(words.end(), small.begin(), small.end());
        return words;
    };
    return {
        {"picture", "a.png", render({"render", four_spheres_file, "-o", "@a.png"})},
        {"frames", "a0003.pfm",
         render({"render", animated, "--frames", "0..3", "-o", "@a%04d.pfm"})},
        {"y4m", "a.y4m", render({"render", animated, "--frames", "0..3", "--y4m", "-o", "@a.y4m"})},
        {"intersect", "a.csv", {"intersect", four_spheres_file, "@rays", "-o", "@a.csv"}},
    };
}

std::string in_folder(std::string word, const TempFolder& folder)
{
    if (const std::size_t at = word.find('@'); at != std::string::npos)
        word.replace(at, 1, (folder / "").string());
    return word;
}

std::vector<std::string> words_of(const Work& work, const TempFolder& folder)
{
    std::vector<std::string> words;
    for (const std::string& word : work.words)
        words.push_back(in_folder(word, folder));
    return words;
}

void write_rays(const TempFolder& folder)
{
    std::string text;
    for (int i = 0; i < 20000; ++i)
        text += "0,0,0," + std::to_string(i % 100 - 50) + ",0," + std::to_string(i % 37 + 1) + "\n";
    write_text(folder / "rays", text);
}

/// Starts the program and ends it by a signal after so long; it may have ended before.
void start_and_end(const Work& work, const TempFolder& folder, int number, int microseconds)
{
    const std::vector<std::string> words = words_of(work, folder);
    std::vector<char*> arguments = {const_cast<char*>(PACKTRACE_CLI)};
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    // No signal reaches the copy of this program before it has become the other: the handlers of
    // the test framework would answer.
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, &before);
    const pid_t process = fork();
    if (process == 0) {
        for (const int ending : {SIGTERM, SIGINT})
            std::signal(ending, SIG_DFL);
        sigprocmask(SIG_SETMASK, &before, nullptr);
        const int nothing = open("/dev/null", O_RDWR);
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            dup2(nothing, stream);
        execv(PACKTRACE_CLI, arguments.data());
        _exit(127);
    }
    sigprocmask(SIG_SETMASK, &before, nullptr);
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
    kill(process, number);
    int status = 0;
    waitpid(process, &status, 0);
}

std::size_t temporaries(const TempFolder& folder)
{
    const std::vector<std::string> names = folder.names();
    return static_cast<std::size_t>(
        std::count_if(names.begin(), names.end(),
                      [](const std::string& name) { return name.ends_with(".tmp"); }));
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
                CHECK(read_text(folder / work.output) == expected);
            CHECK((number == SIGKILL || temporaries(folder) <= before));
        }
        CHECK(run_packtrace(words_of(work, folder)).exit_code == 0);
        CHECK(read_text(folder / work.output) == expected);
        CHECK(temporaries(folder) == 0);
    }
}

/// Creates one file after another, until the process ends.
void write_without_end(const std::filesystem::path& target)
{
    while (true) {
        AtomicFile file(target);
        file.write("text");
        file.commit();
    }
}

/// A process of two writers that ends as the handler of signals ends it.
[[noreturn]] void write_and_end(const TempFolder& folder, int microseconds)
{
    for (const char* const name : {"a", "b"})
        std::thread(write_without_end, folder / name).detach();
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
    remove_all_temporaries();
    _exit(0);
}

}  // namespace

TEST_CASE("no temporary file appears behind a program's clearing up", "[kills]")
{
    const TempFolder folder;
    for (int i = 0; i < 300; ++i) {
        const pid_t process = fork();
        if (process == 0)
            write_and_end(folder, 100 + 7 * i);
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

TEST_CASE("a program ended at three hundred moments leaves whole files or none", "[kills][slow]")
{
    end_at_any_moment(75, 2);
}

}  // namespace packtrace::test
