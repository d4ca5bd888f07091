// --shard of render --frames, intersect and stress, packtrace join, and intersect --resume.
#include "catch.hpp"
#include "core/checksum.hpp"
#include "core/json_text.hpp"
#include "intersect_program.hpp"
#include "job_inputs.hpp"
#include "killed_program.hpp"
#include <packtrace/isa.hpp>

#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

using Words = std::vector<std::string>;

class Bench {
public:
    explicit Bench(int rays)
    {
        write_text(folder / "hand.scene", hand_scene);
        write_text(folder / "rays.csv", many_rays(rays));
    }

    [[nodiscard]] Words words(const std::string& output, const Words& more) const
    {
        Words all{"intersect", folder / "hand.scene", folder / "rays.csv", "-o", folder / output};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] ProgramResult intersect(const std::string& output, const Words& more) const
    {
        return run_packtrace(words(output, more));
    }
    [[nodiscard]] ProgramResult join(const Words& parts, const std::string& output,
                                     const std::string& environment = "") const
    {
        Words all{"join", "-o", folder / output};
        for (const std::string& part : parts)
            all.push_back(folder / part);
        return run_packtrace(all, environment);
    }
    [[nodiscard]] bool same(const std::string& a, const std::string& b) const
    {
        return read_text(folder / a) == read_text(folder / b);
    }

    TempFolder folder;
};

}  // namespace

TEST_CASE("joined shards of rays equal the file of all rays", "[shard]")
{
    const Bench bench(5000);
    for (const Words& query : {Words{}, Words{"--all"}, Words{"--any"}, Words{"--all", "--bounds"}})
        for (const int count : {1, 3, 7}) {
            CAPTURE(query, count);
            REQUIRE(bench.intersect("whole.csv", query).exit_code == 0);
            Words parts;
            // Shards may run in any order.
            for (int i = count - 1; i >= 0; --i) {
                Words more = query;
                more.insert(more.end(),
                            {"--shard", std::to_string(i) + "/" + std::to_string(count)});
                parts.push_back("part" + std::to_string(i));
                REQUIRE(bench.intersect(parts.back(), more).exit_code == 0);
            }
            CHECK(bench.join(parts, "joined.csv").exit_code == 0);
            CHECK(bench.same("joined.csv", "whole.csv"));
        }
}

TEST_CASE("parts of scenes with different cameras are joined", "[shard]")
{
    const Bench bench(50);
    REQUIRE(bench.intersect("whole.csv", {}).exit_code == 0);
    REQUIRE(bench.intersect("p0", {"--shard", "0/2"}).exit_code == 0);
    write_text(bench.folder / "hand.scene",
               std::string(hand_scene) + "\ncamera { position = (1, 2, 3)  fov = 20 }\n");
    REQUIRE(bench.intersect("p1", {"--shard", "1/2"}).exit_code == 0);
    CHECK(bench.join({"p0", "p1"}, "joined.csv").exit_code == 0);
    CHECK(bench.same("joined.csv", "whole.csv"));
}

TEST_CASE("more shards than rays leave some empty", "[shard]")
{
    const Bench bench(3);
    REQUIRE(bench.intersect("whole.csv", {"--all"}).exit_code == 0);
    Words parts;
    for (int i = 0; i < 40; ++i) {
        parts.push_back("part" + std::to_string(i));
        REQUIRE(bench.intersect(parts.back(), {"--all", "--shard", std::to_string(i) + "/40"})
                    .exit_code == 0);
    }
    CHECK(bench.join(parts, "joined.csv").exit_code == 0);
    CHECK(bench.same("joined.csv", "whole.csv"));
    // More parts than the files that the system lets a program open.
    CHECK(bench.join(parts, "joined.csv", "ulimit -n 20;").exit_code == 0);
    CHECK(bench.same("joined.csv", "whole.csv"));
}

TEST_CASE("a wrong ray of a shard is named by its line in the file", "[shard]")
{
    const Bench bench(2000);
    std::string rays = read_text(bench.folder / "rays.csv");
    write_text(bench.folder / "rays.csv", rays + "\n1,2,3,0,0,four\n");
    const ProgramResult whole = bench.intersect("a.csv", {});
    const ProgramResult last = bench.intersect("a.csv", {"--shard", "4/5"});
    CHECK(last.exit_code == 1);
    CHECK(last.err == whole.err);
    CHECK(bench.intersect("a.csv", {"--shard", "3/5"}).exit_code == 0);
}

TEST_CASE("parts that do not belong together are not joined", "[shard]")
{
    const Bench bench(500);
    for (const std::string i : {"0", "1", "2"})
        REQUIRE(bench.intersect("p" + i, {"--shard", i + "/3"}).exit_code == 0);
    REQUIRE(bench.intersect("single", {"--shard", "1/3", "--precision", "single"}).exit_code == 0);
    REQUIRE(bench.intersect("half", {"--shard", "1/2"}).exit_code == 0);
    REQUIRE(bench.intersect("whole", {}).exit_code == 0);
    // Other rays in a file of the same length.
    const std::string rays = read_text(bench.folder / "rays.csv");
    std::string others = rays;
    const std::size_t digit = others.find_last_of("012345678");
    ++others[digit];
    write_text(bench.folder / "rays.csv", others);
    REQUIRE(bench.intersect("other", {"--shard", "1/3"}).exit_code == 0);
    write_text(bench.folder / "rays.csv", rays);
    write_text(bench.folder / "line", "# packtrace part 0/1 of " + std::string(1 << 20, 'x'));
    struct Wrong {
        Words parts;
        const char* message;
    };
    const std::vector<Wrong> wrongs = {
        {{"p0", "p2"}, "part 1/3 is missing"},
        {{"p0", "p1", "p1", "p2"}, "give each part once"},
        {{"p0", "single", "p2"}, "is a part of other work"},
        {{"p0", "half", "p2"}, "is a part of other work"},
        {{"p0", "other", "p2"}, "is a part of other work"},
        {{"whole"}, "is not a part"},
        {{"line"}, "is not a part"},
        {{"none"}, "can't read"},
    };
    for (const Wrong& wrong : wrongs) {
        CAPTURE(wrong.parts);
        const ProgramResult result = bench.join(wrong.parts, "joined.csv");
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.err, ContainsSubstring(wrong.message));
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
        CHECK_FALSE(std::filesystem::exists(bench.folder / "joined.csv"));
    }
}

TEST_CASE("join refuses standard input as a part", "[shard]")
{
    const ProgramResult result = run_packtrace({"join", "-"});
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, ContainsSubstring("'-' is not a file; parts are read twice"));
}

TEST_CASE("truncated and changed parts are not joined", "[shard]")
{
    const Bench bench(500);
    for (const std::string i : {"0", "1"})
        REQUIRE(bench.intersect("p" + i, {"--shard", i + "/2"}).exit_code == 0);
    const std::string whole = read_text(bench.folder / "p1");
    std::string changed = whole;
    changed[whole.size() / 2] ^= 1;
    const std::size_t row = whole.find("\n1,");
    const std::string without_row = whole.substr(0, row) + whole.substr(whole.find('\n', row + 1));
    const std::string wrongs[] = {whole.substr(0, whole.size() / 2),
                                  whole.substr(0, whole.size() - 1),
                                  whole.substr(0, whole.find('\n') + 1),
                                  whole + "0,,,,,\n",
                                  changed,
                                  without_row};
    for (const std::string& wrong : wrongs) {
        CAPTURE(wrong.size());
        write_text(bench.folder / "wrong", wrong);
        const ProgramResult result = bench.join({"p0", "wrong"}, "joined.csv");
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.err, ContainsSubstring("is not all of what packtrace wrote there"));
        CHECK_FALSE(std::filesystem::exists(bench.folder / "joined.csv"));
    }
    CHECK(bench.join({"p0", "p1"}, "joined.csv").exit_code == 0);
}

TEST_CASE("a shard is one of a number of shards", "[shard]")
{
    const Bench bench(5);
    for (const std::string shard : {"3/3", "-1/3", "1", "1/0", "a/b", "0/3x", "0/9999999"}) {
        CAPTURE(shard);
        const ProgramResult result = bench.intersect("a.csv", {"--shard", shard});
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, ContainsSubstring("is not a shard such as 0/8"));
    }
    const ProgramResult piped =
        run_packtrace({"intersect", four_spheres_file, "-", "--shard", "0/2"});
    CHECK(piped.exit_code == 1);
    CHECK_THAT(piped.err, ContainsSubstring("standard input can't be cut into parts"));
    CHECK(
        run_packtrace({"render", four_spheres_file, "-o", bench.folder / "a.png", "--shard", "0/2"})
            .exit_code == 2);
    CHECK(run_packtrace({"stress", "--shard", "0/2"}).exit_code == 2);
}

TEST_CASE("the shards of an animation contain all of its frames", "[shard]")
{
    const TempFolder folder;
    write_text(folder / "a.scene",
               "image_size = 19 x 13\nanimation { frames = 5  orbit { center = (0, 0, 3) } }\n"
               "sphere { center = (0, 1, 3)  radius = 1  color = (200, 40, 30) }\n"
               "light { type = ambient  intensity = 0.5 }\n");
    const auto render = [&](const std::string& name, const Words& more) {
        Words all{"render", folder / "a.scene", "-o", folder / name, "--frames", "1..4"};
        all.insert(all.end(), more.begin(), more.end());
        return run_packtrace(all);
    };
    REQUIRE(render("whole%d.png", {}).exit_code == 0);
    for (const std::string shard : {"0/3", "1/3", "2/3"}) {
        const ProgramResult result = render("part%d.png", {"--shard", shard});
        CHECK(result.exit_code == 0);
        CHECK_THAT(result.err,
                   ContainsSubstring(shard == "0/3" ? "2 frames rendered" : "1 frame rendered"));
    }
    for (const std::string frame : {"1", "2", "3", "4"})
        CHECK(read_text(folder / ("part" + frame + ".png")) ==
              read_text(folder / ("whole" + frame + ".png")));
}

TEST_CASE("joined shards of a stress test have the rows and the verdict of the whole", "[shard]")
{
    const TempFolder folder;
    Words all{"stress", "--json", "--rays", "64", "--kernel", "packet", "--mode", "exact"};
    for (const std::string& family : first_families(4))
        all.insert(all.end(), {"--family", family});
    auto whole = nlohmann::ordered_json::parse(run_packtrace(all).out);
    Words join{"join"};
    for (const std::string i : {"0", "1", "2"}) {
        Words part = all;
        part.insert(part.end(), {"--shard", i + "/3"});
        write_text(folder / i, run_packtrace(part).out);
        join.insert(join.begin() + 1, folder / i);
    }
    auto joined = nlohmann::ordered_json::parse(run_packtrace(join).out);
    // Times differ from run to run, and therefore the best subject too.
    for (auto* const json : {&whole, &joined})
        for (auto& row : (*json)["rows"]) {
            row["ns_per_ray"] = 0;
            row["pareto"] = false;
        }
    CHECK(whole["rows"].size() >= 4);
    CHECK(joined.dump() == whole.dump());

    const auto refused = [&](const Words& parts, const std::string& why) {
        const ProgramResult result = run_packtrace(parts);
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.err, ContainsSubstring(why));
    };
    for (const Words& option : {Words{"--self-hits", "note"}, Words{"--traversal", "list"},
                                Words{"--isa", choose_isa().name}, Words{"--family", "plane"}}) {
        Words part = all;
        part.insert(part.end(), option.begin(), option.end());
        part.insert(part.end(), {"--shard", "1/3"});
        write_text(folder / "other", run_packtrace(part).out);
        refused({"join", folder / "0", folder / "other", folder / "2"}, "of other work");
    }
    std::string edited = read_text(folder / "1");
    edited.replace(edited.find("\"wrong\": 0"), 10, "\"wrong\": 5");
    write_text(folder / "edited", edited);
    refused({"join", folder / "0", folder / "edited", folder / "2"}, "is cut or was changed");
    // Rows of another program with a correct checksum.
    auto foreign = nlohmann::ordered_json::parse(read_text(folder / "1"));
    foreign["rows"][0]["precision"] = "half";
    foreign.erase("checksum");
    foreign["checksum"] = checksum(bytes_of(json_text(foreign)));
    write_text(folder / "foreign", json_text(foreign));
    refused({"join", folder / "0", folder / "foreign", folder / "2"},
            "has a row that stress did not write: 'half' is no precision");
    // Deeply nested JSON.
    constexpr int deep = 200'000;
    write_text(folder / "deep", R"({"shard": "1/3", "rows": )" + std::string(deep, '[') +
                                    std::string(deep, ']') + "}");
    refused({"join", folder / "0", folder / "deep", folder / "2"}, "is no part");
    // Only these two fields, with a correct checksum.
    nlohmann::ordered_json bare{{"shard", "1/3"}, {"rows", nlohmann::ordered_json::array()}};
    bare["checksum"] = checksum(bytes_of(json_text(bare)));
    write_text(folder / "bare", json_text(bare));
    refused({"join", folder / "bare"}, "is no part");
    join.pop_back();
    refused(join, "is missing");
}

TEST_CASE("intersect resumes after the last complete block", "[shard]")
{
    const Bench bench(60000);
    for (const Words& query : {Words{"--threads", "1"}, Words{"--all", "--shard", "1/2"}}) {
        REQUIRE(bench.intersect("whole.csv", query).exit_code == 0);
        Words resume = query;
        resume.push_back("--resume");
        Words all = bench.words("a.csv", resume);
        all.insert(all.begin(), PACKTRACE_CLI);
        for (const long blocks : {1L, 5L}) {
            const int status = kill_program(all, SIGKILL, [&] {
                return lines_of(bench.folder / "a.csv.journal") >= 2 + blocks;
            });
            REQUIRE(WIFSIGNALED(status));
        }
        CHECK_FALSE(std::filesystem::exists(bench.folder / "a.csv"));
        const std::string journal = read_text(bench.folder / "a.csv.journal");
        const std::string part = read_text(bench.folder / "a.csv.part");

        // Other options and other rays are refused.
        const ProgramResult other = bench.intersect("a.csv", {"--resume", "--precision", "single"});
        CHECK(other.exit_code == 1);
        CHECK_THAT(other.err, ContainsSubstring(" with --precision double"));
        const std::string rays = read_text(bench.folder / "rays.csv");
        std::string changed = rays;
        for (char& c : changed)
            if (c == '7')
                c = '8';
        write_text(bench.folder / "rays.csv", changed);
        CHECK_THAT(bench.intersect("a.csv", resume).err,
                   ContainsSubstring("was begun with other rays"));
        write_text(bench.folder / "rays.csv", rays);

        for (const std::size_t lost : {std::size_t{0}, std::size_t{3}, std::size_t{200}}) {
            write_text(bench.folder / "a.csv.journal", journal);
            write_text(bench.folder / "a.csv.part", part.substr(0, part.size() - lost));
            CHECK(bench.intersect("a.csv", resume).exit_code == 0);
            CHECK(bench.same("a.csv", "whole.csv"));
            CHECK((bench.folder.names() == Words{"a.csv", "hand.scene", "rays.csv", "whole.csv"}));
            std::filesystem::remove(bench.folder / "a.csv");
        }
    }
    CHECK(bench.intersect("", {"--resume"}).exit_code != 0);
}

}  // namespace packtrace::test
