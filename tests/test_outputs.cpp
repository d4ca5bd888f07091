// Destinations of output: links, pipes, full disks, interrupted and killed programs.
#include "catch.hpp"
#include "core/atomic_file.hpp"
#include "fork_child.hpp"
#include "run_program.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace packtrace::test {
namespace {

ProgramResult render_small(const std::filesystem::path& picture)
{
    return run_packtrace(
        {"render", four_spheres_file, "--size", "16x12", "-q", "-o", picture.string()});
}

/// Starts `packtrace intersect` with rays from a pipe that stays open and empty. The program has
/// begun its output and waits.
class WaitingProgram {
public:
    explicit WaitingProgram(const TempFolder& folder) : output_(folder / "hits.csv")
    {
        const std::string rays = (folder / "rays").string();
        REQUIRE(mkfifo(rays.c_str(), 0600) == 0);
        process_ = fork_child([&] {
            // SIGQUIT would write the memory into a file.
            const rlimit no_core{};
            setrlimit(RLIMIT_CORE, &no_core);
            const int input = open(rays.c_str(), O_RDONLY);
            const int errors = open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0600);
            dup2(input, STDIN_FILENO);
            dup2(errors, STDERR_FILENO);
            execl(PACKTRACE_CLI, PACKTRACE_CLI, "intersect", four_spheres_file.c_str(), "-", "-o",
                  output_.c_str(), static_cast<char*>(nullptr));
        });
        pipe_ = open(rays.c_str(), O_WRONLY);
    }
    ~WaitingProgram()
    {
        close(pipe_);
    }
    WaitingProgram(const WaitingProgram&) = delete;
    WaitingProgram& operator=(const WaitingProgram&) = delete;

    /// Waits for the temporary file, then sends `number`. Returns when the process has ended but
    /// has not been reaped.
    void send(int number, const TempFolder& folder) const
    {
        for (int i = 0; i < 6000 && temporaries(folder) == 0; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        REQUIRE(temporaries(folder) == 1);
        kill(process_, number);
        siginfo_t how{};
        REQUIRE(waitid(P_PID, static_cast<id_t>(process_), &how, WEXITED | WNOWAIT) == 0);
    }

    /// As send(), then reaps the process and returns waitpid()'s status.
    [[nodiscard]] int end_by(int number, const TempFolder& folder) const
    {
        send(number, folder);
        return status();
    }

    [[nodiscard]] int status() const
    {
        int status = 0;
        waitpid(process_, &status, 0);
        return status;
    }

    [[nodiscard]] static std::size_t temporaries(const TempFolder& folder)
    {
        std::size_t count = 0;
        for (const std::string& name : folder.names())
            count += std::size_t{name.ends_with(".tmp")};
        return count;
    }

private:
    std::filesystem::path output_;
    pid_t process_ = 0;
    int pipe_ = -1;
};

}  // namespace

TEST_CASE("output through a link replaces the target of the link", "[outputs]")
{
    const TempFolder folder;
    write_text(folder / "real.pfm", "before");
    std::filesystem::create_symlink("real.pfm", folder / "link.pfm");
    std::filesystem::create_symlink("new.pfm", folder / "dangling.pfm");
    CHECK(render_small(folder / "link.pfm").exit_code == 0);
    CHECK(render_small(folder / "dangling.pfm").exit_code == 0);
    CHECK(std::filesystem::is_symlink(folder / "link.pfm"));
    CHECK(std::filesystem::is_symlink(folder / "dangling.pfm"));
    CHECK(read_text(folder / "real.pfm") == read_text(folder / "new.pfm"));
    CHECK(read_text(folder / "real.pfm").starts_with("PF"));
}

TEST_CASE("a replaced file keeps its permissions", "[outputs]")
{
    const TempFolder folder;
    const std::filesystem::path picture = folder / "a.pfm";
    for (const unsigned mode : {0600u, 0664u, 0640u}) {
        write_text(picture, "before");
        REQUIRE(chmod(picture.c_str(), mode) == 0);
        CHECK(render_small(picture).exit_code == 0);
        struct stat found {};
        REQUIRE(stat(picture.c_str(), &found) == 0);
        CHECK((found.st_mode & 0777u) == mode);
        CHECK(read_text(picture).starts_with("PF"));
    }
}

TEST_CASE("output into a file without a name replaces nothing", "[outputs]")
{
    const TempFolder folder;
    const std::filesystem::path file = folder / "a";
    const int handle = open(file.c_str(), O_RDWR | O_CREAT, 0600);
    std::filesystem::remove(file);
    write_file("/dev/fd/" + std::to_string(handle), "text");
    CHECK(lseek(handle, 0, SEEK_END) == 4);
    CHECK(folder.names().empty());
    close(handle);
}

TEST_CASE("output into a pipe goes through the pipe", "[outputs]")
{
    const TempFolder folder;
    const std::string pipe = (folder / "pipe.pfm").string();
    const std::string copy = (folder / "copy.pfm").string();
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::thread reader([&] {
        std::ifstream from(pipe, std::ios::binary);
        std::ofstream(copy, std::ios::binary) << from.rdbuf();
    });
    CHECK(render_small(pipe).exit_code == 0);
    reader.join();
    CHECK(std::filesystem::is_fifo(pipe));
    CHECK(render_small(folder / "file.pfm").exit_code == 0);
    CHECK(read_text(copy) == read_text(folder / "file.pfm"));
}

TEST_CASE("the longest permitted file name is written, and a longer one is refused", "[outputs]")
{
    const TempFolder folder;
    CHECK(render_small(folder / (std::string(251, 'a') + ".pfm")).exit_code == 0);
    const ProgramResult longer = render_small(folder / (std::string(252, 'a') + ".pfm"));
    CHECK(longer.exit_code == 1);
    CHECK_THAT(longer.err, ContainsSubstring("File name too long"));
}

TEST_CASE("results that do not fit on standard output end with exit code 1", "[outputs]")
{
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"info", four_spheres_file}, {"--help"}, {"render", "--help"}, {"stress", "--list"}}) {
        std::string command = shell_quoted(PACKTRACE_CLI);
        for (const std::string& word : words)
            command += " " + shell_quoted(word);
        for (const std::string lost : {"/dev/full", "&-"}) {
            CAPTURE(command, lost);
            const int status = std::system((command + " >" + lost + " 2>/dev/null").c_str());
            CHECK(WEXITSTATUS(status) == 1);
        }
    }
}

TEST_CASE("an interrupted program removes its unfinished file and ends by the signal", "[outputs]")
{
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        const TempFolder folder;
        const WaitingProgram program(folder);
        const int status = program.end_by(number, folder);
        CAPTURE(number);
        CHECK(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == number);
        CHECK(WaitingProgram::temporaries(folder) == 0);
        CHECK_FALSE(std::filesystem::exists(folder / "hits.csv"));
        CHECK_THAT(read_text(folder / "err"), ContainsSubstring("interrupted"));
    }
}

TEST_CASE("the unfinished file of a killed program is removed by the next one with the same output",
          "[outputs]")
{
    const TempFolder folder;
    {
        const WaitingProgram program(folder);
        const int status = program.end_by(SIGKILL, folder);
        CHECK(WIFSIGNALED(status));
        CHECK(WaitingProgram::temporaries(folder) == 1);
    }
    // A living writer keeps its file.
    AtomicFile living(folder / "hits.csv");
    CHECK(WaitingProgram::temporaries(folder) == 1);
    AtomicFile second(folder / "hits.csv");
    CHECK(WaitingProgram::temporaries(folder) == 2);
    living.commit();
    second.commit();
    CHECK(WaitingProgram::temporaries(folder) == 0);
}

TEST_CASE("the unfinished file of a killed program is removed even if its parent has not reaped it",
          "[outputs]")
{
    const TempFolder folder;
    const WaitingProgram program(folder);
    program.send(SIGKILL, folder);
    AtomicFile next(folder / "hits.csv");
    CHECK(WaitingProgram::temporaries(folder) == 1);
    next.commit();
    CHECK(WaitingProgram::temporaries(folder) == 0);
    CHECK(WIFSIGNALED(program.status()));
}

TEST_CASE("unfinished files of killed programs beside finished frames are removed by the next run",
          "[outputs]")
{
    const TempFolder folder;
    const std::vector<std::string> words{"render",
                                         PACKTRACE_SOURCE_DIR "/scenes/flight.scene",
                                         "--size",
                                         "16x12",
                                         "-q",
                                         "--frames",
                                         "0..2",
                                         "-o",
                                         (folder / "f%d.png").string()};
    REQUIRE(run_packtrace(words).exit_code == 0);
    const std::vector<std::string> frames = folder.names();
    // No process has a number this large.
    write_text(folder / ".f1.png.4194305-0.tmp", "half a picture");
    const std::string living = ".f1.png." + std::to_string(getpid()) + "-0.tmp";
    write_text(folder / living, "of this process");
    CHECK(run_packtrace(words).exit_code == 0);
    CHECK(std::filesystem::remove(folder / living));
    CHECK(folder.names() == frames);
}

TEST_CASE("messages show file names without control characters", "[outputs]")
{
    const TempFolder folder;
    const std::string scene = (folder / "\x1b[31mred\n.scene").string();
    std::filesystem::copy_file(four_spheres_file, scene);
    const std::string picture = (folder / "\x1b[31mred\n.pfm").string();
    const ProgramResult rendered = run_packtrace({"render", scene, "--size", "8x8", "-o", picture});
    CHECK(rendered.exit_code == 0);
    CHECK_THAT(rendered.err, ContainsSubstring("\\x1b[31mred\\x0a.pfm"));
    const ProgramResult info = run_packtrace({"info", scene});
    CHECK(info.exit_code == 0);
    const std::string systems = (folder / "\x1b[31mred\n.txt").string();
    write_text(systems, "?\n");
    const ProgramResult solved = run_packtrace({"onedim", systems, "--keep-going"});
    CHECK(solved.exit_code == 1);
    for (const std::string& text : {rendered.err, info.out, info.err, solved.err}) {
        CAPTURE(text);
        CHECK(text.find("\x1b") == std::string::npos);
    }
}

TEST_CASE("no more threads are started than are useful", "[outputs]")
{
    const TempFolder folder;
    const ProgramResult result =
        run_packtrace({"render", four_spheres_file, "--size", "64x48", "-q", "--threads", "1024",
                       "-o", (folder / "a.pfm").string()});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.err, ContainsSubstring("--threads 1024"));
}

}  // namespace packtrace::test
