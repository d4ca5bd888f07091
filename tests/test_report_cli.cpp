// The program's `report`.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "run_program.hpp"

namespace packtrace::test {
namespace {

ProgramResult run_report(const TempFolder& folder, std::vector<std::string> more,
                         const std::string& environment = "")
{
    std::vector<std::string> words{"report",      "--cache", (folder / "cache").string(),
                                   "--size",      "40x32",   "--quick",
                                   "--truth-spp", "20"};
    words.insert(words.end(), more.begin(), more.end());
    return run_packtrace(words, environment);
}

}  // namespace

TEST_CASE("report writes its files and prints a judgement of each scene", "[report_cli]")
{
    const TempFolder folder;
    const ProgramResult result =
        run_report(folder, {four_spheres_file, four_spheres_file, "-o", (folder / "out").string(),
                            "--repetitions", "2", "--max-error", "0.5", "--max-time", "1e6"});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(result.err.empty());
    for (const char* scene : {"four_spheres, ", "four_spheres_2, "})
        for (const char* study : {"arithmetic: ", "depth: ", "weight: ", "sampling: "})
            CHECK_THAT(result.out, ContainsSubstring(std::string(scene) + study + "Cheapest"));
    const auto json = nlohmann::json::parse(read_text(folder / "out" / "report.json"));
    CHECK(json["repetitions"] == 2);
    CHECK(json["max_time_s"] == 1000.0);
    CHECK(json["scenes"].size() == 2);
    const std::string command = json["conditions"]["command"];
    CHECK_THAT(command, ContainsSubstring("packtrace report "));
    CHECK_THAT(command, ContainsSubstring(" --repetitions 2"));
    CHECK_THAT(command, ContainsSubstring(" --quick"));
    CHECK_THAT(read_text(folder / "out" / "report.md"), ContainsSubstring(command));
}

TEST_CASE("a second report takes the truth from the cache", "[report_cli]")
{
    const TempFolder folder;
    const auto cached = [&](const std::string& name) {
        REQUIRE(run_report(folder, {four_spheres_file, "-o", (folder / name).string()}).exit_code ==
                0);
        const auto json = nlohmann::json::parse(read_text(folder / name / "report.json"));
        return json["scenes"][0]["studies"][3]["truth"]["cached"].get<bool>();
    };
    CHECK_FALSE(cached("first"));
    CHECK(cached("second"));
}

TEST_CASE("report refuses wrong use in one line", "[report_cli]")
{
    const TempFolder folder;
    const auto message = [&](const std::vector<std::string>& words) {
        const ProgramResult result = run_report(folder, words);
        CHECK(result.exit_code == 2);
        return result.err;
    };
    const std::string out = (folder / "out").string();
    CHECK_THAT(message({"-o", out}), ContainsSubstring("SCENE"));
    CHECK_THAT(message({four_spheres_file}), ContainsSubstring("--output"));
    CHECK_THAT(message({four_spheres_file, "-o", out, "--repetitions", "0"}),
               ContainsSubstring("--repetitions"));
    CHECK_THAT(message({four_spheres_file, "-o", out, "--threads", "1,x"}),
               ContainsSubstring("--threads"));
    CHECK_THAT(message({four_spheres_file, "-o", out, "--max-error", "0"}),
               ContainsSubstring("--max-error"));
    CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("report fails in one line for what it can't read, write or run", "[report_cli]")
{
    const TempFolder folder;
    const auto failure = [](const ProgramResult& result) {
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
        return result.err;
    };
    CHECK_THAT(failure(run_report(folder, {"missing.scene", "-o", (folder / "a").string()})),
               ContainsSubstring("missing.scene"));
    write_text(folder / "file", "");
    CHECK_THAT(
        failure(run_report(folder, {four_spheres_file, "-o", (folder / "file" / "out").string()})),
        ContainsSubstring("out"));
    CHECK_THAT(failure(run_report(folder, {four_spheres_file, "-o", (folder / "b").string()},
                                  "PATH=/nowhere")),
               ContainsSubstring("apt-get install gnuplot-nox"));
}

}  // namespace packtrace::test
