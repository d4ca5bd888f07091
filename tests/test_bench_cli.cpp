// The command `bench`: times against a baseline.
#include "catch.hpp"
#include "killed_program.hpp"
#include "run_program.hpp"
#include <packtrace/isa.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

namespace packtrace::test {
namespace {

using nlohmann::json;

ProgramResult run_bench(const std::vector<std::string>& more, const std::string& repetitions = "9")
{
    std::vector<std::string> words{"bench", four_spheres_file, "--size",        "64x64",
                                   "--isa", choose_isa().name, "--repetitions", repetitions};
    words.insert(words.end(), more.begin(), more.end());
    return run_packtrace(words);
}

/// A baseline with the ratios of `file` times `factor`. A factor far from 1 exceeds any difference
/// between runs on one machine.
std::string scaled_baseline(const TempFolder& folder, const std::string& file, double factor)
{
    json baseline = json::parse(read_text(file));
    for (json& line : baseline["lines"])
        for (json& ratio : line["ratios"])
            ratio = ratio.get<double>() * factor;
    const std::string scaled = (folder / "scaled.json").string();
    write_text(scaled, baseline.dump());
    return scaled;
}

}  // namespace

TEST_CASE("bench writes each line's ratio to the scalar reference", "[bench_cli]")
{
    const TempFolder folder;
    const std::string file = (folder / "bench.json").string();
    const ProgramResult result = run_bench({"-o", file});
    REQUIRE(result.exit_code == 0);
    const json bench = json::parse(read_text(file));
    CHECK(bench["packtrace_bench"] == 1);
    CHECK(bench["conditions"]["compiler"].is_string());
    CHECK_THAT(bench["conditions"]["commit"].get<std::string>(),
               Catch::Matchers::Matches("[0-9a-f]{7,40}(-dirty)?|unknown"));
    CHECK_THAT(bench["conditions"]["flags"].get<std::string>(),
               ContainsSubstring("-ffp-contract=off"));
    CHECK(bench["conditions"]["load_before"].is_number());
    CHECK(bench["conditions"]["load_after"].is_number());
    REQUIRE(bench["lines"].size() == 3);
    for (const json& line : bench["lines"]) {
        CHECK(line["ratio"] > 0.0);
        CHECK(line["ratios"].size() == 9);
        CHECK_THAT(result.out, ContainsSubstring(line["name"].get<std::string>()));
    }
    const std::string packets = "four_spheres, packets " + choose_isa().name + " single";
    CHECK(bench["lines"][0]["name"] == packets);
    CHECK(bench["lines"][1]["name"] == "four_spheres, scalar double");
}

TEST_CASE("bench shows the row that the others are compared to", "[bench_cli]")
{
    const TempFolder folder;
    const std::string file = (folder / "bench.json").string();
    const ProgramResult result = run_bench({"-o", file}, "1");
    CHECK_THAT(result.out, ContainsSubstring("four_spheres, scalar single (the reference)"));
    const json bench = json::parse(read_text(file));
    REQUIRE(bench["references"].size() == 1);
    CHECK(bench["references"][0]["name"] == "four_spheres, scalar single");
    CHECK(bench["references"][0]["milliseconds"] > 0.0);
}

TEST_CASE("bench fails with the row that is slower than the baseline, and only then", "[bench_cli]")
{
    const TempFolder folder;
    const std::string file = (folder / "bench.json").string();
    REQUIRE(run_bench({"-o", file}).exit_code == 0);
    const ProgramResult faster = run_bench({"--baseline", scaled_baseline(folder, file, 1e4)});
    CHECK(faster.exit_code == 0);
    CHECK(faster.err.empty());
    const std::string fast = scaled_baseline(folder, file, 1e-4);
    const ProgramResult slower = run_bench({"--baseline", fast, "--max-slowdown", "50%"});
    CHECK(slower.exit_code == 1);
    CHECK_THAT(slower.err, ContainsSubstring("slower: four_spheres, packets "));
    CHECK_THAT(slower.err, ContainsSubstring("against the baseline, with 27 repetitions"));
    CHECK(run_bench({"--baseline", fast, "--max-slowdown", "1000000"}).exit_code == 0);
}

TEST_CASE("bench reports an undecided comparison with an exit code of its own", "[bench_cli]")
{
    const TempFolder folder;
    const std::string file = (folder / "bench.json").string();
    REQUIRE(run_bench({"-o", file}, "2").exit_code == 0);
    const ProgramResult result = run_bench({"--baseline", file}, "2");
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.out, ContainsSubstring("too few repetitions"));
    CHECK_THAT(result.err, ContainsSubstring("can't tell: four_spheres, packets "));
    CHECK_THAT(result.err, ContainsSubstring("more --repetitions"));
}

TEST_CASE("bench ends the program that it has started", "[bench_cli]")
{
    if (std::string_view(PACKTRACE_CLI).ends_with("_emulated"))
        return;
    const TempFolder folder;
    // Reports its start and the signal that ends it.
    const std::filesystem::path other = folder / "other";
    const std::filesystem::path begun = folder / "begun";
    const std::filesystem::path ended = folder / "ended";
    write_text(other, "#!/bin/sh\ntrap 'echo >" + ended.string() + "; exit 1' TERM\necho >" +
                          begun.string() + "\nwhile sleep 0.1; do :; done\n");
    std::filesystem::permissions(other, std::filesystem::perms::owner_all);
    const auto is_there = [](const std::filesystem::path& file) {
        return std::filesystem::exists(file);
    };
    const int status =
        kill_program({PACKTRACE_CLI, "bench", four_spheres_file, "--against", other.string()},
                     SIGTERM, [&] { return is_there(begun); });
    CHECK(WIFSIGNALED(status));
    for (int i = 0; i < 1000 && !is_there(ended); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK(is_there(ended));
}

TEST_CASE("bench alternates its runs with those of another program", "[bench_cli]")
{
    // The program also starts itself, which fails for an emulated program.
    if (std::string_view(PACKTRACE_CLI).ends_with("_emulated"))
        return;
    const TempFolder folder;
    const std::string file = (folder / "bench.json").string();
    const ProgramResult result =
        run_bench({"--against", PACKTRACE_CLI, "--max-slowdown", "1000000", "-o", file}, "8");
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out, ContainsSubstring("scalar single (the reference)"));
    const json bench = json::parse(read_text(file));
    REQUIRE(bench["lines"].size() == 3);
    for (const json& line : bench["lines"])
        CHECK(line["ratios"].size() == 8);

    const auto failure = [&](const std::string& program) {
        const ProgramResult bad = run_bench({"--against", program});
        CHECK(bad.exit_code == 1);
        CHECK(std::count(bad.err.begin(), bad.err.end(), '\n') == 1);
        return bad.err;
    };
    CHECK_THAT(failure((folder / "none").string()), ContainsSubstring("can't be run"));
    CHECK_THAT(failure("false"), ContainsSubstring("its 'bench' fails"));
    CHECK_THAT(failure("true"), ContainsSubstring("its 'bench' fails"));
    CHECK(run_bench({"--against", "true", "--baseline", file}).exit_code == 2);
    const ProgramResult from_input = run_packtrace({"bench", "-", "--against", PACKTRACE_CLI});
    CHECK(from_input.exit_code == 2);
    CHECK_THAT(from_input.err, ContainsSubstring("give files"));
}

TEST_CASE("bench refuses a file that is no baseline", "[bench_cli]")
{
    const TempFolder folder;
    const auto failure = [&](const std::string& text) {
        write_text(folder / "b.json", text);
        const ProgramResult result = run_bench({"--baseline", (folder / "b.json").string()});
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
        return result.err;
    };
    const std::string none = "not a file that packtrace bench -o writes";
    for (const char* text :
         {"", "[]", R"({"packtrace_bench": 1})",
          R"({"packtrace_bench": 1, "lines": [{"name": "a"}]})",
          R"({"packtrace_bench": 1, "lines": [{"name": "a", "milliseconds": 1, "ratios": []}]})",
          R"({"packtrace_bench": 1, "lines": [{"name": "a", "milliseconds": 1, "ratios": [0]}]})"})
        CHECK_THAT(failure(text), ContainsSubstring(none));
    CHECK_THAT(
        failure(
            R"({"packtrace_bench": 1, "lines": [{"name": "a", "milliseconds": 1, "ratios": [1]}]})"),
        ContainsSubstring("no line of these scenes"));
    // Another scene of the same name, alone and together with the first.
    write_text(folder / "four_spheres.scene", "sphere { center = (0, 0, 3)  radius = 1 }");
    const std::string kept = (folder / "kept.json").string();
    REQUIRE(run_bench({"-o", kept}, "2").exit_code == 0);
    const std::string own = (folder / "four_spheres.scene").string();
    const ProgramResult other =
        run_packtrace({"bench", own, "--size", "64x64", "--repetitions", "2", "--baseline", kept});
    CHECK(other.exit_code == 1);
    CHECK_THAT(other.err, ContainsSubstring("its four_spheres is another scene"));
    const std::string both = (folder / "both.json").string();
    REQUIRE(run_bench({own, "-o", both}, "2").exit_code == 0);
    const json lines = json::parse(read_text(both))["lines"];
    CHECK(std::any_of(lines.begin(), lines.end(), [](const json& line) {
        return line["name"].get<std::string>().starts_with("four_spheres_2, ");
    }));
    const ProgramResult missing = run_bench({"--baseline", (folder / "c.json").string()});
    CHECK(missing.exit_code == 1);
    CHECK_THAT(missing.err, ContainsSubstring("c.json"));
    CHECK(run_bench({"--max-slowdown", "ten"}).exit_code == 2);
}

}  // namespace packtrace::test
