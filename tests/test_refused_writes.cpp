// Files that can't be written: full disks, file size limits, folders without write permission.
#include "catch.hpp"
#include "program_works.hpp"

#include <algorithm>
#include <filesystem>
#include <linux/capability.h>
#include <set>
#include <string>
#include <sys/prctl.h>
#include <thread>

namespace packtrace::test {
namespace {

/// Checks that a failed run reports this in one line and leaves neither its last file nor an
/// unfinished one.
void check_refused(const Work& work, const TempFolder& folder, const ProgramResult& result,
                   const std::string& why)
{
    CAPTURE(work.name, result.err);
    CHECK(result.exit_code == 1);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK_THAT(result.err, ContainsSubstring(why));
    CHECK_FALSE(std::filesystem::is_regular_file(folder / work.output));
    CHECK(temporaries(folder) == 0);
}

/// Runs the program on a thread without special privileges: there root, too, needs file
/// permissions.
ProgramResult run_without_privileges(const std::vector<std::string>& words)
{
    ProgramResult result;
    std::thread([&] {
        for (const int capability : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH})
            prctl(PR_CAPBSET_DROP, capability, 0, 0, 0);
        result = run_packtrace(words);
    }).join();
    return result;
}

/// Makes a folder read-only for the lifetime of the object.
class ReadOnly {
public:
    explicit ReadOnly(std::filesystem::path path) : path_(std::move(path))
    {
        using std::filesystem::perms;
        permissions(path_, perms::owner_read | perms::owner_exec);
    }
    ~ReadOnly()
    {
        permissions(path_, std::filesystem::perms::owner_all);
    }
    ReadOnly(const ReadOnly&) = delete;
    ReadOnly& operator=(const ReadOnly&) = delete;

private:
    std::filesystem::path path_;
};

}  // namespace

TEST_CASE("on a full disk a run ends with one line and leaves no unfinished file",
          "[refused_writes]")
{
    for (const Work& work : all_work()) {
        const TempFolder folder;
        write_rays(folder);
        const std::filesystem::path output = folder / work.output;
        create_directories(output.parent_path());
        // Writing through the link fails: no space left.
        std::filesystem::create_symlink("/dev/full", output);
        check_refused(work, folder, run_packtrace(words_of(work, folder)),
                      "No space left on device");
    }
}

TEST_CASE("past a limit of file size a run ends with one line and leaves no unfinished file",
          "[refused_writes]")
{
    for (const Work& work : all_work()) {
        const TempFolder folder;
        write_rays(folder);
        // Blocks of 512 or 1024 bytes.
        const ProgramResult result = run_packtrace(words_of(work, folder), "ulimit -f 1;");
        check_refused(work, folder, result, "File too large");
    }
}

TEST_CASE("a report that can't be written as a whole leaves none of its files", "[refused_writes]")
{
    const std::vector<Work> works = all_work();
    const auto report = std::find_if(works.begin(), works.end(),
                                     [](const Work& work) { return work.name == "report"; });
    REQUIRE(report != works.end());
    const TempFolder folder;
    // Blocks of 512 or 1024 bytes: the page is longer than the pictures.
    const auto run = [&] { return run_packtrace(words_of(*report, folder), "ulimit -f 30;"); };
    CHECK(run().exit_code == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "a"));

    create_directories(folder / "a/four_spheres");
    write_text(folder / "a/four_spheres/notes", "mine");
    write_text(folder / "a/report.csv", "an earlier one");
    CHECK(run().exit_code == 1);
    std::set<std::string> left;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "a"))
        left.insert(entry.path().lexically_relative(folder / "a"));
    CHECK(left == std::set<std::string>{"four_spheres", "four_spheres/notes", "report.csv"});
}

TEST_CASE("in a folder without write permission a run ends with one line", "[refused_writes]")
{
    for (const Work& work : all_work()) {
        const TempFolder folder;
        write_rays(folder);
        const ReadOnly read_only(folder / "");
        check_refused(work, folder, run_without_privileges(words_of(work, folder)),
                      "Permission denied");
    }
}

TEST_CASE("a file without write permission is not replaced", "[refused_writes]")
{
    const TempFolder folder;
    const std::filesystem::path picture = folder / "a.pfm";
    write_text(picture, "before");
    std::filesystem::permissions(picture, std::filesystem::perms::owner_read);
    const ProgramResult result = run_without_privileges(
        {"render", four_spheres_file, "--size", "8x8", "-q", "-o", picture.string()});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, ContainsSubstring("Permission denied"));
    CHECK(read_text(picture) == "before");
    CHECK(folder.names().size() == 1);
}

TEST_CASE("a scene without read permission is refused in one line", "[refused_writes]")
{
    const TempFolder folder;
    const std::string scene = (folder / "a.scene").string();
    std::filesystem::copy_file(four_spheres_file, scene);
    std::filesystem::permissions(scene, std::filesystem::perms::none);
    const std::string picture = (folder / "a.png").string();
    const ProgramResult result = run_without_privileges({"render", scene, "-q", "-o", picture});
    CHECK(result.exit_code == 1);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK_THAT(result.err, ContainsSubstring("Permission denied"));
    CHECK_FALSE(std::filesystem::exists(picture));
}

}  // namespace packtrace::test
