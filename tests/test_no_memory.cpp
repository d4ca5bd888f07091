// Each allocation of a render fails once: the program ends with one line, or does without.
#include <algorithm>

#include "catch.hpp"
#include "run_program.hpp"

namespace packtrace::test {
namespace {

ProgramResult render(const std::string& picture, int threads, const std::string& at)
{
    return run_packtrace({"render", four_spheres_file, "--size", "24x18", "-q", "--threads",
                          std::to_string(threads), "-o", picture},
                         "FAIL_MALLOC_AT=" + at + " LD_PRELOAD=" PACKTRACE_FAIL_MALLOC);
}

/// Renders with the allocation of that number failing; returns whether it did fail.
bool render_without(long allocation, const std::string& expected, int threads = 2)
{
    const TempFolder folder;
    const std::string picture = (folder / "a.pfm").string();
    const ProgramResult result = render(picture, threads, std::to_string(allocation));
    CAPTURE(allocation, result.err);
    if (result.exit_code == 0) {
        CHECK(read_text(picture) == expected);
        return false;
    }
    CHECK(result.exit_code == 1);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    // No picture, whole or half, and nothing else.
    CHECK(folder.names().empty());
    return true;
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
    const std::string expected = whole_picture();
    long failed = 0;
    for (long allocation = 1; allocation < 12000; allocation += 331)
        failed += render_without(allocation, expected) ? 1 : 0;
    CHECK(failed > 3);
}

// Where the picture is written, the program can't fail any more.
TEST_CASE("none of a render's last allocations fails a whole picture", "[no_memory]")
{
    const std::string expected = whole_picture();
    const TempFolder folder;
    const ProgramResult counted = render((folder / "a.pfm").string(), 1, "count");
    CAPTURE(counted.err);
    REQUIRE(counted.exit_code == 0);
    const long all = std::stol(counted.err);
    REQUIRE(all > 100);
    long failed = 0;
    for (long allocation = all - 60; allocation <= all; ++allocation)
        failed += render_without(allocation, expected, 1) ? 1 : 0;
    CHECK(failed > 0);
}

// The library, used by a program that goes on after it has run out of memory.
TEST_CASE("what runs out of memory gives back what it had taken", "[no_memory]")
{
    for (const std::string work : {"picture", "tree", "queries", "lights", "update"}) {
        const ProgramResult result = run_command({PACKTRACE_LEAKS, work});
        CAPTURE(work, result.out, result.err);
        CHECK(result.exit_code == 0);
    }
}

TEST_CASE("each of the first ten thousand allocations of a render may fail", "[no_memory][slow]")
{
    const std::string expected = whole_picture();
    for (long allocation = 1; allocation <= 10000; ++allocation)
        render_without(allocation, expected);
}

}  // namespace packtrace::test
