// Each allocation of a render fails once: the program ends with one line, or works without it.
#include "catch.hpp"
#include "run_program.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace packtrace::test {
namespace {

/// Too long for a string's small buffer, so that the string allocates.
const std::string picture_name = "a_picture_of_four_spheres.pfm";

/// Renders in a folder, with an environment variable that selects the failing allocations.
ProgramResult render_in(const TempFolder& folder, int threads, const std::string& at)
{
    return run_command({"sh", "-c",
                        "cd " + shell_quoted(folder / "") + " && FAIL_MALLOC_AT=" + at +
                            " LD_PRELOAD=" PACKTRACE_FAIL_MALLOC " " + shell_quoted(PACKTRACE_CLI) +
                            " render " + shell_quoted(four_spheres_file) + " --size 24x18 -q -o " +
                            picture_name + " --threads " + std::to_string(threads)});
}

/// Renders repeatedly with one failing allocation: numbers `first`, `first + step` and so on up to
/// `last`. Returns the number of runs that failed.
long render_without(long first, long last, long step, const std::string& expected, int threads = 2)
{
    const TempFolder folder;
    const ProgramResult all = render_in(
        folder, threads,
        std::to_string(first) + ".." + std::to_string(last) + ".." + std::to_string(step));
    REQUIRE(all.exit_code == 0);
    std::istringstream lines(all.out);
    long runs = 0;
    long failed = 0;
    for (long allocation = first, exit_code = 0; lines >> allocation >> exit_code; ++runs) {
        const std::string name = std::to_string(allocation);
        const std::string err = read_text(folder / (name + ".err"));
        // Each run has its own folder.
        const std::filesystem::path own = folder / name;
        CAPTURE(allocation, err);
        REQUIRE(allocation == first + runs * step);
        if (exit_code == 0) {
            CHECK(read_text(own / picture_name) == expected);
            continue;
        }
        ++failed;
        CHECK(exit_code == 1);
        CHECK(std::count(err.begin(), err.end(), '\n') == 1);
        // No picture, whole or partial, and no other file.
        CHECK(std::filesystem::is_empty(own));
    }
    CHECK(runs == (last - first) / step + 1);
    return failed;
}

/// The number of allocations of a complete render.
long allocations_of_render(int threads)
{
    const TempFolder folder;
    const ProgramResult counted = render_in(folder, threads, "count");
    CAPTURE(counted.err);
    REQUIRE(counted.exit_code == 0);
    return std::stol(counted.err);
}

std::string whole_picture()
{
    const TempFolder folder;
    const std::string picture = (folder / "a.pfm").string();
    REQUIRE(run_packtrace({"render", four_spheres_file, "--size", "24x18", "-q", "-o", picture})
                .exit_code == 0);
    return read_text(picture);
}

}  // namespace

TEST_CASE("a render that runs out of memory says so and leaves nothing", "[no_memory]")
{
    CHECK(render_without(1, allocations_of_render(2), 151, whole_picture()) > 3);
}

// Once the picture is written, the program can't fail any more.
TEST_CASE("the last allocations of a render do not fail after the picture is written",
          "[no_memory]")
{
    const long all = allocations_of_render(1);
    REQUIRE(all > 100);
    CHECK(render_without(all - 60, all, 1, whole_picture(), 1) > 0);
}

// The library in a program that continues after it has run out of memory.
TEST_CASE("work that runs out of memory releases what it had allocated", "[no_memory]")
{
    for (const std::string work : {"picture", "tree", "queries", "lights", "update"}) {
        const ProgramResult result = run_command({PACKTRACE_LEAKS, work});
        CAPTURE(work, result.out, result.err);
        CHECK(result.exit_code == 0);
    }
}

TEST_CASE("each allocation of a render may fail", "[no_memory][slow]")
{
    // With two threads the number of allocations varies.
    const long all = allocations_of_render(2) + 100;
    CHECK(render_without(1, all, 1, whole_picture()) > 1000);
}

}  // namespace packtrace::test
