// The command `report`.
#include "catch.hpp"
#include "run_program.hpp"
#include <packtrace/write_report.hpp>

#include <nlohmann/json.hpp>

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
                            "--repetitions", "2", "--max-error", "1/2", "--max-time", "1e6"});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(result.err.empty());
    for (const char* scene : {"four_spheres, ", "four_spheres_2, "})
        for (const char* study : {"arithmetic: ", "depth: ", "weight: ", "sampling: "})
            CHECK_THAT(result.out, ContainsSubstring(std::string(scene) + study + "Cheapest"));
    const auto json = nlohmann::json::parse(read_text(folder / "out" / "report.json"));
    CHECK(json["repetitions"] == 2);
    CHECK(json["max_error"] == 0.5);
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

TEST_CASE("a scene's file name can't change where a report is written", "[report_cli]")
{
    const TempFolder folder;
    const std::string text = "image_size = 8 x 8\nsphere { center = (0, 0, 3)  radius = 1 }\n";
    const std::filesystem::path touched = folder / "touched";
    const std::vector<std::string> names = {
        "...scene",           "report.html.scene", "a'\nsystem \"touch touched\"\n.scene",
        "<!--<script>.scene", "\xff.scene",        "\xfe.scene"};
    std::vector<std::string> words{"-o", (folder / "out").string()};
    for (const std::string& name : names) {
        write_text(folder / name, text);
        words.push_back((folder / name).string());
    }
    const ProgramResult result = run_report(folder, words);
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK_FALSE(std::filesystem::exists(touched));
    CHECK_FALSE(std::filesystem::exists("touched"));
    CHECK(folder.names().size() == names.size() + 2);
    const auto json = nlohmann::json::parse(read_text(folder / "out" / "report.json"));
    CHECK(json["scenes"].size() == names.size());
    for (const auto& scene : json["scenes"]) {
        const std::string name = scene["name"];
        INFO(name);
        CHECK(name == report_folder_name(name));
        CHECK(std::filesystem::is_regular_file(folder / "out" / name / "depth.svg"));
    }
    CHECK(read_text(folder / "out" / "report.html").find("<!--<script>") == std::string::npos);
}

TEST_CASE("names of scenes become valid folder names", "[report_cli]")
{
    CHECK(report_folder_name("four spheres") == "four spheres");
    CHECK(report_folder_name("gr\xc3\xb6\xc3\x9f"
                             "e") ==
          "gr\xc3\xb6\xc3\x9f"
          "e");
    CHECK(report_folder_name("") == "_");
    CHECK(report_folder_name("..") == "_..");
    CHECK(report_folder_name("a/b\nc") == "a_b_x0ac");
    CHECK(report_folder_name("\xff") == "_xff");
    CHECK(report_folder_name("report.html") == "report.html_");
    CHECK(report_folder_name(std::string(300, 'x')) == std::string(200, 'x'));
    for (const char* name : {"..", "\xff", "a\nb", "report.md"})
        CHECK(report_folder_name(report_folder_name(name)) == report_folder_name(name));
    SceneReport scene;
    scene.name = "../elsewhere";
    const TempFolder folder;
    CHECK_THROWS_WITH(write_report({scene}, {}, {}, folder / "out"),
                      ContainsSubstring("can't be its folder"));
    scene.name = "here";
    CHECK_THROWS_WITH(write_report({scene}, {}, {}, folder / "out"),
                      ContainsSubstring("without pictures"));
    CHECK(folder.names().empty());
}

TEST_CASE("messages have one line, whatever the name of a file", "[report_cli]")
{
    const TempFolder folder;
    for (const char* command : {"render", "report", "demo", "bench"}) {
        const ProgramResult result = run_packtrace(
            {command, (folder / "a\nb\x1b[31m.scene").string(), "-o", (folder / "x.png").string()});
        INFO(command << ": " << result.err);
        CHECK(result.exit_code != 0);
        CHECK(result.err.find('\n') == result.err.size() - 1);
        CHECK(result.err.find('\x1b') == std::string::npos);
    }
    const ProgramResult result =
        run_packtrace({"compare", (folder / "a\nb.png").string(), "c\nd.png"});
    CHECK(result.exit_code != 0);
    CHECK(result.err.find('\n') == result.err.size() - 1);
}

TEST_CASE("a folder that can't be made is named with the reason", "[report_cli]")
{
    const TempFolder folder;
    write_text(folder / "file", "");
    for (const char* command : {"report", "demo"}) {
        const ProgramResult result =
            run_packtrace({command, four_spheres_file, "-o", (folder / "file" / "out").string()});
        CHECK(result.exit_code == 1);
        CHECK(result.err ==
              (folder / "file" / "out").string() + ": can't make this folder: Not a directory\n");
    }
}

TEST_CASE("a report that is refused leaves no folder behind", "[report_cli]")
{
    const TempFolder folder;
    const std::string out = (folder / "a" / "out").string();
    const ProgramResult result =
        run_packtrace({"report", four_spheres_file, "-o", out, "--quick", "--truth-spp", "16",
                       "--cache", (folder / "cache").string()});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, ContainsSubstring("(truth_samples, --truth-spp) cannot judge"));
    CHECK(folder.names().empty());
    for (const char* threads : {"1,,2", ",1", "1,", "", "0", "1;2", "1025"})
        CHECK_THAT(
            run_packtrace({"report", four_spheres_file, "-o", out, "--threads", threads}).err,
            ContainsSubstring("with commas between them"));
    CHECK(folder.names().empty());
}

TEST_CASE("report.md contains a scene's name unchanged, and links to its pictures", "[report_cli]")
{
    const TempFolder folder;
    const std::filesystem::path scene = folder / "a|b%20#1 [x](y) <z>.scene";
    write_text(scene, read_text(four_spheres_file));
    const ProgramResult result =
        run_report(folder, {scene.string(), "-o", (folder / "out").string(), "--repetitions", "1"});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    const std::string page = read_text(folder / "out" / "report.md");
    CHECK_THAT(page, ContainsSubstring("\n## a\\|b%20\\#1 \\[x\\]\\(y\\) \\<z\\>, 40 x 32\n"));
    CHECK_THAT(page, ContainsSubstring("![the truth](a%7Cb%2520%231%20%5Bx%5D%28y%29%20%3Cz%3E/"));
}

TEST_CASE("where no truth can be kept a report is made without", "[report_cli]")
{
    const TempFolder folder;
    write_text(folder / "file", "");
    const std::string out = (folder / "out").string();
    const std::string nowhere = (folder / "file" / "home").string();
    const std::vector<std::string> words{
        "report", four_spheres_file, "--size", "8x8", "--quick", "-q", "-o", out};
    const ProgramResult kept_none =
        run_packtrace(words, "XDG_CACHE_HOME= HOME=" + shell_quoted(nowhere));
    CHECK(kept_none.exit_code == 0);
    CHECK_THAT(kept_none.err, ContainsSubstring("warning: " + nowhere));
    CHECK_THAT(kept_none.err, ContainsSubstring("--cache"));
    CHECK(std::filesystem::exists(folder / "out" / "report.md"));
    // Nor in a folder that hangs on where the program is started.
    const ProgramResult relative =
        run_packtrace(words, "XDG_CACHE_HOME=packtrace_relative HOME=" + shell_quoted(folder / ""));
    CHECK(relative.exit_code == 0);
    CHECK_FALSE(std::filesystem::exists("packtrace_relative"));
    CHECK(std::filesystem::exists(folder / ".cache" / "packtrace"));
    // One that was asked for has to do.
    std::vector<std::string> asked = words;
    asked.insert(asked.end(), {"--cache", nowhere});
    const ProgramResult refused = run_packtrace(asked);
    CHECK(refused.exit_code == 1);
    CHECK_THAT(refused.err, ContainsSubstring(nowhere));
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
    for (const std::string bad : {"0", "0/5", "-1", "1/0", "x"})
        CHECK_THAT(message({four_spheres_file, "-o", out, "--max-error", bad}),
                   ContainsSubstring("--max-error: '" + bad +
                                     "' is not a number above 0, or a fraction such as 1/255"));
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
