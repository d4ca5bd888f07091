// The program's `bench`: times against a baseline.
#include <packtrace/isa.hpp>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "run_program.hpp"

namespace packtrace::test {
namespace {

using nlohmann::json;

ProgramResult run_bench(const std::vector<std::string>& more)
{
    std::vector<std::string> words{"bench", four_spheres_file, "--size",        "64x64",
                                   "--isa", choose_isa().name, "--repetitions", "3"};
    words.insert(words.end(), more.begin(), more.end());
    return run_packtrace(words);
}

/// A baseline whose ratios are those of `file` times `factor`.
void scale_baseline(const std::filesystem::path& file, double factor)
{
    json baseline = json::parse(read_text(file));
    for (json& line : baseline["lines"])
        line["ratio"] = line["ratio"].get<double>() * factor;
    write_text(file, baseline.dump());
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
    REQUIRE(bench["lines"].size() == 3);
    for (const json& line : bench["lines"]) {
        CHECK(line["ratio"] > 0.0);
        CHECK(line["ratios"].size() == 3);
        CHECK_THAT(result.out, ContainsSubstring(line["name"].get<std::string>()));
    }
    const std::string packets = "four_spheres, packets " + choose_isa().name + " single";
    CHECK(bench["lines"][0]["name"] == packets);
    CHECK(bench["lines"][1]["name"] == "four_spheres, scalar double");
}

TEST_CASE("bench fails with the line that is slower than the baseline, and only then",
          "[bench_cli]")
{
    const TempFolder folder;
    const std::string file = (folder / "bench.json").string();
    REQUIRE(run_bench({"-o", file}).exit_code == 0);
    // Factors that no other work of the machine reaches.
    scale_baseline(file, 1e6);
    CHECK(run_bench({"--baseline", file}).exit_code == 0);
    scale_baseline(file, 1e-9);
    const ProgramResult slower = run_bench({"--baseline", file, "--max-slowdown", "50%"});
    CHECK(slower.exit_code == 1);
    CHECK_THAT(slower.err, ContainsSubstring("slower: four_spheres, packets "));
    CHECK_THAT(slower.err, ContainsSubstring("over the baseline"));
    CHECK(run_bench({"--baseline", file, "--max-slowdown", "1000000"}).exit_code == 0);
}

TEST_CASE("bench refuses a baseline that is none", "[bench_cli]")
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
         {"", "[]", "{\"packtrace_bench\": 1}",
          "{\"packtrace_bench\": 1, \"lines\": [{\"name\": \"a\"}]}",
          "{\"packtrace_bench\": 1, \"lines\": [{\"name\": \"a\", \"ratio\": 0}]}"})
        CHECK_THAT(failure(text), ContainsSubstring(none));
    CHECK_THAT(failure("{\"packtrace_bench\": 1, \"lines\": [{\"name\": \"a\", \"ratio\": 1}]}"),
               ContainsSubstring("no line of what was measured"));
    const ProgramResult missing = run_bench({"--baseline", (folder / "c.json").string()});
    CHECK(missing.exit_code == 1);
    CHECK_THAT(missing.err, ContainsSubstring("c.json"));
    CHECK(run_bench({"--max-slowdown", "ten"}).exit_code == 2);
}

}  // namespace packtrace::test
