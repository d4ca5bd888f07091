#include "catch.hpp"
#include "memory_limit.hpp"
#include "run_on_terminal.hpp"
#include "run_program.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <nlohmann/json.hpp>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace packtrace {
namespace {

using test::ContainsSubstring;
using test::ProgramResult;
using test::read_text;
using test::run_packtrace;
using test::TempFolder;
using test::write_text;
using Words = std::vector<std::string>;

const std::string four_spheres = PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene";

// `packtrace render SCENE -o OUTPUT --size 40x30 …`
ProgramResult render_small(const std::string& scene, const std::string& output, const Words& more,
                           const std::string& environment = "")
{
    Words words{"render", scene, "-o", output, "--size", "40x30"};
    words.insert(words.end(), more.begin(), more.end());
    return run_packtrace(words, environment);
}

// The words that `packtrace --help` lists under its heading for subcommands, which CLI11
// spells with small letters before its version 2.5.
Words listed_commands()
{
    std::istringstream help(run_packtrace({"--help"}).out);
    Words commands;
    bool listing = false;
    for (std::string line; std::getline(help, line);) {
        if (line.starts_with("Subcommands:") || line.starts_with("SUBCOMMANDS:"))
            listing = true;
        else if (listing && line.size() > 2 && line[2] != ' ')
            commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    return commands;
}

// Ends a program that does not stop: after 20 seconds of its own processor time, a hundred times
// what a refusal takes. Other programs on a busy machine do not count.
const std::string ends_soon = "ulimit -t 20;";

bool is_one_line(const std::string& text)
{
    return !text.empty() && text.find('\n') == text.size() - 1;
}

Scene small_scene()
{
    Scene scene = read_scene(four_spheres);
    scene.width = 40;
    scene.height = 30;
    return scene;
}

}  // namespace

TEST_CASE("every command has a help text", "[cli]")
{
    const Words commands = listed_commands();
    REQUIRE(commands.size() >= 4);
    for (const std::string& command : commands) {
        const ProgramResult result = run_packtrace({command, "--help"});
        INFO(command);
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        CHECK_THAT(result.out, ContainsSubstring("packtrace " + command));
        CHECK_THAT(result.out, ContainsSubstring("--help"));
    }
}

TEST_CASE("a command's help names its options", "[cli]")
{
    const std::vector<std::pair<std::string, std::string>> options{
        {"render", "--precision"},   {"compare", "--max-error"}, {"info", "--json"},
        {"intersect", "--any"},      {"explain", "--pixel"},     {"demo", "--rounds"},
        {"onedim", "--keep-going"},  {"stress", "--family"},     {"render", "--accuracy"},
        {"render", "--self-hits"},   {"explain", "--accuracy"},  {"explain", "--self-hits"},
        {"profile", "--accuracy"},   {"profile", "--self-hits"}, {"intersect", "--accuracy"},
        {"intersect", "--traversal"}};
    for (const auto& [command, option] : options)
        CHECK_THAT(run_packtrace({command, "--help"}).out, ContainsSubstring(option));
}

TEST_CASE("the version is one line", "[cli]")
{
    const ProgramResult result = run_packtrace({"--version"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out, ContainsSubstring("packtrace "));
    CHECK(is_one_line(result.out));
}

TEST_CASE("render writes what the library renders", "[cli]")
{
    const TempFolder folder;
    const ProgramResult result = render_small(four_spheres, folder / "a.pfm", {});
    CHECK(result.exit_code == 0);
    CHECK(result.out.empty());
    CHECK(is_one_line(result.err));
    CHECK_THAT(result.err, ContainsSubstring("a.pfm: 40 x 30, packet, " + choose_isa().name));
    const Image<float> expected = render<float>(small_scene());
    CHECK((read_image(folder / "a.pfm").rgb == expected.rgb));
}

TEST_CASE("render takes the scalar kernel in three precisions", "[cli]")
{
    const TempFolder folder;
    const RenderOptions scalar{.kernel = Kernel::scalar};
    const Scene scene = small_scene();
    const std::vector<std::pair<std::string, Image<float>>> expected{
        {"single", render<float>(scene, scalar)},
        {"double", convert<float>(render<double>(scene, scalar))},
        {"extended", convert<float>(render<long double>(scene, scalar))}};
    CHECK((expected[0].second.rgb != expected[1].second.rgb));
    for (const auto& [precision, image] : expected) {
        const ProgramResult result =
            render_small(four_spheres, folder / "a.pfm",
                         {"--kernel", "scalar", "--precision", precision, "--quiet"});
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        CHECK((read_image(folder / "a.pfm").rgb == image.rgb));
    }
}

TEST_CASE("render takes every instruction set, width and number of threads", "[cli]")
{
    const TempFolder folder;
    for (const IsaInfo& isa : list_isas()) {
        if (!isa.supported)
            continue;
        const Words forced{"--isa", isa.name, "--width", std::to_string(isa.lanes_single)};
        const ProgramResult result = render_small(four_spheres, folder / "a.png", forced);
        CHECK(result.exit_code == 0);
        CHECK_THAT(result.err, ContainsSubstring("packet, " + isa.name));
        const ProgramResult variable =
            render_small(four_spheres, folder / "a.png", {}, "PACKTRACE_ISA=" + isa.name);
        CHECK_THAT(variable.err, ContainsSubstring("packet, " + isa.name));
    }
    for (const std::string threads : {"1", "2", "7"}) {
        const ProgramResult result =
            render_small(four_spheres, folder / (threads + ".pfm"), {"--threads", threads, "-q"});
        CHECK(result.err.empty());
        CHECK(read_text(folder / (threads + ".pfm")) == read_text(folder / "1.pfm"));
    }
}

TEST_CASE("render's depth and gamma change the picture", "[cli]")
{
    const TempFolder folder;
    Scene scene = small_scene();
    scene.max_depth = 0;
    CHECK(render_small(four_spheres, folder / "flat.pfm", {"--depth", "0"}).exit_code == 0);
    CHECK((read_image(folder / "flat.pfm").rgb == render<float>(scene).rgb));

    CHECK(render_small(four_spheres, folder / "g.png", {"--gamma", "2.2"}).exit_code == 0);
    write_image(folder / "expected.png", render<float>(small_scene()), {.gamma = 2.2});
    CHECK(read_text(folder / "g.png") == read_text(folder / "expected.png"));
}

TEST_CASE("wrong use exits 2 with one line and leaves no file", "[cli]")
{
    const TempFolder folder;
    const std::string out = folder / "a.png";
    const std::vector<std::pair<Words, std::string>> wrong{
        {{}, "subcommand is required"},
        {{"rendr"}, "unknown subcommand 'rendr'"},
        {{"render"}, "SCENE is required"},
        {{"render", four_spheres}, "--output is required"},
        {{"info", ""}, "'' is not a file's name"},
        {{"demo", ""}, "'' is not a file's name"},
        {{"bench", four_spheres, ""}, "'' is not a file's name"},
        {{"render", four_spheres, "-o", ""}, "'' is not a file's name"},
        {{"report", four_spheres, "-o", ""}, "'' is not a folder's name"},
        {{"stress", "--cases", ""}, "'' is not a folder's name"},
        {{"render", four_spheres, "-o", out, "--kernel", "gpu"}, "'gpu' is not packet or scalar"},
        {{"render", four_spheres, "-o", out, "--precision", "half"},
         "'half' is not single, double or extended"},
        {{"render", four_spheres, "-o", out, "--precision", "extended"},
         "extended needs --kernel scalar"},
        {{"render", four_spheres, "-o", out, "--isa", "mmx"},
         "--isa: unknown instruction set 'mmx'"},
        {{"render", four_spheres, "-o", out, "--isa", ""}, "--isa: unknown instruction set ''"},
        {{"render", four_spheres, "-o", out, "--width", "5"}, "'5' is not 1, 4, 8 or 16"},
        {{"render", four_spheres, "-o", out, "--kernel", "scalar", "--isa", "auto"},
         "--isa: only packets have one"},
        {{"render", four_spheres, "-o", out, "--kernel", "scalar", "--width", "4"},
         "--width: only packets have one"},
        {{"render", four_spheres, "-o", out, "--threads", "0"}, "'0' is not a whole number"},
        {{"render", four_spheres, "-o", out, "--threads", "2x"}, "'2x' is not a whole number"},
        {{"render", four_spheres, "-o", out, "--size", "0x5"}, "'0x5' is not a size"},
        {{"render", four_spheres, "-o", out, "--size", "640"}, "'640' is not a size"},
        {{"render", four_spheres, "-o", out, "--size", "64x48x3"}, "'64x48x3' is not a size"},
        {{"render", four_spheres, "-o", out, "--size", "70000x1"}, "from 1 to 65536"},
        {{"render", four_spheres, "-o", out, "--depth", "-1"}, "'-1' is not a whole number"},
        {{"render", four_spheres, "-o", out, "--min-weight", "1.5"},
         "'1.5' is not a number from 0 to 1"},
        {{"render", four_spheres, "-o", out, "--min-weight", "nan"},
         "'nan' is not a number from 0 to 1"},
        {{"render", four_spheres, "-o", out, "--gamma", "0"}, "'0' is not a number above 0"},
        {{"render", four_spheres, "-o", out, "--gamma", "nan"}, "'nan' is not a number above 0"},
        {{"render", four_spheres, "-o", folder / "a.pfm", "--gamma", "2"}, "only PNG has one"},
        {{"render", four_spheres, "-o", out, "--nonsense"}, "--nonsense"},
        {{"info", "--isa", "mmx"}, "--isa: unknown instruction set 'mmx'"},
        {{"demo", "--rounds", "0"}, "'0' is not a whole number"},
        {{"render", four_spheres, "-o", out, "--size", "8x8", "--size", "9x9"},
         "--size: given 2 times; give it once"},
        {{"render", four_spheres, "-o", out, "--size"}, "--size: needs a value, WxH"},
        {{"bench", four_spheres, "-o", ""}, "'' is not the name of a file"},
        {{"bench", four_spheres, "-o", "-"}, "'-' is not the name of a file of its own"},
        {{"profile", four_spheres, "--trace", "-"}, "'-' is not the name of a file of its own"},
        {{"profile", four_spheres, "--heatmap", ""}, "'' is not a file's name"},
        {{"compare", out, out, "--heatmap", ""}, "'' is not a file's name"},
        {{"generate", "lattice", "-o", ""}, "'' is not a file's name"},
        {{"intersect", four_spheres, out, "-o", ""}, "'' is not a file's name"},
        {{"join", out, out, "-o", ""}, "'' is not a file's name"},
    };
    for (const auto& [words, reason] : wrong) {
        const ProgramResult result = run_packtrace(words);
        INFO(reason);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK(is_one_line(result.err));
        CHECK_THAT(result.err, ContainsSubstring(reason));
        CHECK(folder.names().empty());
    }
}

TEST_CASE("a picture too large for memory is refused with its size", "[cli]")
{
    const std::string limit = test::memory_limit(4'000'000);
    if (limit.empty())
        return;
    const TempFolder folder;
    const auto render_part = [&](const std::string& precision) {
        return run_packtrace(
            {"render", four_spheres, "-o", folder / "a.pfm", "--size", "40000x20000", "--region",
             "0,0,20000,20000", "--precision", precision, "--threads", "2"},
            limit);
    };
    for (const auto& [precision, bytes] :
         {std::pair{"single", "4.8 GB"}, std::pair{"double", "9.6 GB"}}) {
        const ProgramResult result = render_part(precision);
        CHECK(result.exit_code == 1);
        CHECK(result.out.empty());
        CHECK(result.err == std::string("not enough memory for 20000 x 20000 pixels, which alone "
                                        "take ") +
                                bytes + "; render fewer pixels at once\n");
    }
    CHECK(folder.names().empty());
}

TEST_CASE("a mistyped word gets a suggestion and the command whose help to read", "[cli]")
{
    const std::vector<std::pair<Words, std::string>> wrong{
        {{"rendr", "x"},
         "packtrace: unknown subcommand 'rendr'; did you mean render? See packtrace --help\n"},
        {{"x.scene", "-o", "x.png"},
         "packtrace: unknown subcommand 'x.scene'; see packtrace --help\n"},
        {{"generate", "latice"},
         "packtrace generate: unknown subcommand 'latice'; did you mean lattice? See packtrace "
         "generate --help\n"},
        {{"generate", "lattice", "--egde", "3"},
         "packtrace generate lattice: unknown option '--egde'; did you mean --edge? See packtrace "
         "generate lattice --help\n"},
        {{"render", four_spheres, "--ouput=x.png"},
         "packtrace render: unknown option '--ouput'; did you mean --output? See packtrace render "
         "--help\n"},
        {{"render", four_spheres, "-o", "x.png", "second", "third"},
         "packtrace render: unexpected argument 'second'; see packtrace render --help\n"},
        // The value of an unknown option may stand elsewhere, too.
        {{"render", four_spheres, "-o", "x.png", "--depth", "3", "--dept", "3"},
         "packtrace render: unknown option '--dept'; did you mean --depth? See packtrace render "
         "--help\n"},
        {{"intersect", four_spheres, "rays.csv", "--threads", "2", "--shards", "2"},
         "packtrace intersect: unknown option '--shards'; did you mean --shard? See packtrace "
         "intersect --help\n"},
        {{"render", "--", four_spheres, "second", "-o", "x.png"},
         "packtrace render: unexpected argument 'second'; see packtrace render --help\n"},
        {{"explain", four_spheres},
         "packtrace explain: --pixel is required; see packtrace explain "
         "--help\n"}};
    for (const auto& [words, message] : wrong) {
        const ProgramResult result = run_packtrace(words);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK(result.err == message);
    }
}

TEST_CASE("every command that reads a scene reads it from standard input too", "[cli]")
{
    const TempFolder folder;
    const std::string rays = folder / "rays.csv";
    write_text(rays, "0,0,0,0,0,1\n");
    const std::vector<Words> commands{
        {"render", "-", "-q", "--size", "40x30", "-o", folder / "piped.png"},
        {"info", "-"},
        {"intersect", "-", rays},
        {"explain", "-", "--size", "40x30", "--pixel", "3,4"},
        {"profile", "-", "--size", "8x8", "--repetitions", "1", "--json"},
        {"bench", "-", "--size", "8x8", "--repetitions", "1"},
        {"demo", "-", "--size", "8x8", "--rounds", "1", "-o", folder / "demo"}};
    for (const Words& words : commands) {
        CAPTURE(words);
        const ProgramResult result = run_packtrace(words, "", four_spheres);
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
    }
    CHECK(render_small(four_spheres, folder / "named.png", {"-q"}).exit_code == 0);
    CHECK(read_text(folder / "piped.png") == read_text(folder / "named.png"));
    CHECK(std::filesystem::exists(folder / "demo" / "stdin.png"));
    CHECK_THAT(run_packtrace({"info", "-"}, "", four_spheres).out,
               ContainsSubstring("scene    standard input\n"));
}

TEST_CASE("an unusable scene from standard input is reported as such", "[cli]")
{
    const TempFolder folder;
    const std::string out = folder / "a.png";
    write_text(folder / "bad.scene", "\nsphere { radius = -1 }\n");
    const ProgramResult bad = run_packtrace({"render", "-", "-o", out}, "", folder / "bad.scene");
    CHECK(bad.exit_code == 1);
    CHECK(is_one_line(bad.err));
    CHECK(bad.err.starts_with("standard input:2:"));
    const ProgramResult nothing = run_packtrace({"render", "-", "-o", out});
    CHECK(nothing.exit_code == 1);
    CHECK(is_one_line(nothing.err));
    const ProgramResult unreadable = run_packtrace({"render", "-", "-o", out}, "", "/");
    CHECK(unreadable.exit_code == 1);
    CHECK(unreadable.err == "standard input: can't read: Is a directory\n");
    const ProgramResult twice =
        run_packtrace({"report", "-", "-", "-o", folder / "report"}, "", four_spheres);
    CHECK(twice.exit_code == 1);
    CHECK(twice.err == "standard input: has been read already; give - for one scene only\n");
    const ProgramResult both = run_packtrace({"intersect", "-", "-"}, "", four_spheres);
    CHECK(both.exit_code == 2);
    CHECK(is_one_line(both.err));
    CHECK_THAT(both.err, ContainsSubstring("the scene or the rays, not both"));
    CHECK(folder.names() == Words{"bad.scene"});
}

TEST_CASE("a rotation rounded to four digits is rendered with one warning", "[cli]")
{
    const TempFolder folder;
    write_text(folder / "turned.scene",
               "sphere { center = (0,0,5) radius = 1 }\n"
               "camera { rotation = (0.7071,0,-0.7071, 0,1,0, 0.7071,0,0.7071) }\n");
    const Words words{"render", folder / "turned.scene", "-q", "--size", "8x8",
                      "-o",     folder / "a.png"};
    const ProgramResult result = run_packtrace(words);
    CHECK(result.exit_code == 0);
    CHECK(is_one_line(result.err));
    CHECK(result.err.starts_with("warning: " + (folder / "turned.scene").string() + ":2:10: "));
    CHECK_THAT(result.err, ContainsSubstring("the nearest one is used"));
}

TEST_CASE("a wrong PACKTRACE_ISA exits 2 and names the variable", "[cli]")
{
    const TempFolder folder;
    const ProgramResult result =
        render_small(four_spheres, folder / "a.png", {}, "PACKTRACE_ISA=mmx");
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK_THAT(result.err, ContainsSubstring("PACKTRACE_ISA: unknown instruction set 'mmx'"));
    CHECK(folder.names().empty());
    // The scalar kernel ignores the variable.
    const Words scalar{"--kernel", "scalar"};
    CHECK(render_small(four_spheres, folder / "a.png", scalar, "PACKTRACE_ISA=mmx").exit_code == 0);
}

TEST_CASE("bad scenes exit 1 with one line, at once, and leave no picture", "[cli]")
{
    const TempFolder folder;
    const std::string light = "light { type = ambient intensity = 0.2 }\n";
    const std::string sphere = "sphere { center = (0,0,5) radius = 1 }\n";
    std::string binary(5000, '\0');
    for (std::size_t i = 0; i < binary.size(); ++i)
        binary[i] = static_cast<char>(i * 167 % 256);
    const std::size_t huge = 100'000'000;
    const std::vector<std::pair<std::string, std::string>> scenes{
        {"empty", ""},
        {"binary", binary},
        {"missing brace", "sphere { center = (0,0,5) radius = 1\n" + light},
        {"unknown key", light + "sphere { center = (0,0,5) radius = 1 colour = (1,2,3) }\n"},
        {"negative radius", light + "sphere { center = (0,0,5) radius = -1 }\n"},
        {"nan", light + "sphere { center = (0,0,nan) radius = 1 }\n"},
        {"long word", light + sphere + std::string(huge, 'a')},
        {"long number", light + "sphere { center = (0,0,5) radius = " + std::string(huge, '1')},
        {"many brackets", light + "sphere { center = " + std::string(huge, '(')},
    };
    for (const auto& [name, text] : scenes) {
        write_text(folder / "bad.scene", text);
        const ProgramResult result =
            render_small(folder / "bad.scene", folder / "a.png", {}, ends_soon);
        INFO(name << ": " << result.err.substr(0, 200));
        CHECK(result.exit_code == 1);
        CHECK(result.out.empty());
        CHECK(is_one_line(result.err));
        CHECK(result.err.size() < 400);
        CHECK_THAT(result.err, ContainsSubstring("bad.scene:"));
        CHECK(folder.names() == Words{"bad.scene"});
    }
}

TEST_CASE("a scene that is missing or a folder exits 1 and says so", "[cli]")
{
    const TempFolder folder;
    const ProgramResult missing = render_small(folder / "none.scene", folder / "a.png", {});
    CHECK(missing.exit_code == 1);
    CHECK(is_one_line(missing.err));
    CHECK_THAT(missing.err, ContainsSubstring("No such file or directory"));
    const ProgramResult directory = render_small(folder / "", folder / "a.png", {});
    CHECK(directory.exit_code == 1);
    CHECK(is_one_line(directory.err));
    CHECK(folder.names().empty());
}

TEST_CASE("an output that can't be written is reported before the rendering", "[cli]")
{
    const TempFolder folder;
    const std::vector<std::pair<std::string, std::string>> outputs{
        {"a.jpg", "use .png, .pfm or .hdr"},
        {"none/a.png", "No such file or directory"},
        {"folder.png", "Is a directory"}};
    std::filesystem::create_directory(folder / "folder.png");
    for (const auto& [name, reason] : outputs) {
        // A picture that would take minutes to render.
        const ProgramResult result = run_packtrace({"render", four_spheres, "-o", folder / name,
                                                    "--size", "20000x20000", "--kernel", "scalar"},
                                                   ends_soon);
        CHECK(result.exit_code == 1);
        CHECK(is_one_line(result.err));
        CHECK_THAT(result.err, ContainsSubstring(name));
        CHECK_THAT(result.err, ContainsSubstring(reason));
        CHECK(folder.names() == Words{"folder.png"});
    }
}

TEST_CASE("an existing picture is replaced, and kept when writing fails", "[cli]")
{
    const TempFolder folder;
    write_text(folder / "a.pfm", "old");
    // A limit of one block on the size of files simulates a full disk.
    const ProgramResult full =
        render_small(four_spheres, folder / "a.pfm", {}, "trap '' XFSZ; ulimit -f 1;");
    CHECK(full.exit_code == 1);
    CHECK(full.err == (folder / "a.pfm").string() + ": can't write: File too large\n");
    CHECK(folder.names() == Words{"a.pfm"});
    CHECK(read_text(folder / "a.pfm") == "old");

    CHECK(render_small(four_spheres, folder / "a.pfm", {}).exit_code == 0);
    CHECK(folder.names() == Words{"a.pfm"});
    CHECK(read_text(folder / "a.pfm").substr(0, 9) == "PF\n40 30\n");
}

TEST_CASE("info lists the machine's instruction sets and the one chosen", "[cli]")
{
    const ProgramResult text = run_packtrace({"info"});
    CHECK(text.exit_code == 0);
    CHECK(text.err.empty());
    const auto json = nlohmann::json::parse(run_packtrace({"info", "--json"}).out);
    CHECK(json["chosen"] == choose_isa().name);
    const std::vector<IsaInfo> isas = list_isas();
    REQUIRE(json["isas"].size() == isas.size());
    for (std::size_t i = 0; i < isas.size(); ++i) {
        CHECK_THAT(text.out, ContainsSubstring(isas[i].name));
        CHECK(json["isas"][i]["name"] == isas[i].name);
        CHECK(json["isas"][i]["lanes_single"] == isas[i].lanes_single);
        CHECK(json["isas"][i]["lanes_double"] == isas[i].lanes_double);
        CHECK(json["isas"][i]["supported"] == isas[i].supported);
        if (isas[i].supported)
            CHECK(nlohmann::json::parse(
                      run_packtrace({"info", "--json", "--isa", isas[i].name}).out)["chosen"] ==
                  isas[i].name);
    }
}

TEST_CASE("info describes a scene", "[cli]")
{
    const ProgramResult text = run_packtrace({"info", four_spheres});
    CHECK_THAT(text.out, ContainsSubstring("objects  4 (4 sphere)\n"));
    CHECK_THAT(text.out, ContainsSubstring("lights   3 (1 ambient, 1 point, 1 directional)\n"));
    const auto scene =
        nlohmann::json::parse(run_packtrace({"info", four_spheres, "--json"}).out)["scene"];
    CHECK(scene["width"] == 512);
    CHECK(scene["objects"] == nlohmann::json({{"sphere", 4}}));
    CHECK(scene["lights"] == nlohmann::json({{"ambient", 1}, {"point", 1}, {"directional", 1}}));
    CHECK(scene["model"] == "scratch");
    CHECK(scene["depth"] == 3);
    CHECK(scene["shadows"] == "opaque");
    CHECK(run_packtrace({"info", four_spheres + "x"}).exit_code == 1);
}

TEST_CASE("info lists the keys of the scene language", "[cli]")
{
    const ProgramResult lights = run_packtrace({"info", "--keys", "lights"});
    CHECK(lights.exit_code == 0);
    CHECK_THAT(lights.out, ContainsSubstring("| `position` | point | needed | `point` only |"));
    const ProgramResult all = run_packtrace({"info", "--keys", "all"});
    CHECK_THAT(all.out, ContainsSubstring("lights\n\n" + lights.out));
    const ProgramResult wrong = run_packtrace({"info", "--keys", "light"});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.out.empty());
    CHECK(wrong.err.find('\n') == wrong.err.size() - 1);
}

TEST_CASE("demo renders with every kernel and writes the picture", "[cli]")
{
    const TempFolder folder;
    const ProgramResult result =
        run_packtrace({"demo", four_spheres, "-o", folder / "out", "--size", "64x48", "--rounds",
                       "2", "--threads", "2"});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    const auto rows = [&](const std::string& kernel) {
        std::size_t count = 0;
        for (std::size_t at = result.out.find("\n" + kernel); at != std::string::npos;
             at = result.out.find("\n" + kernel, at + 1))
            ++count;
        return count;
    };
    std::size_t supported = 0;
    for (const IsaInfo& isa : list_isas())
        supported += isa.supported;
    CHECK(rows("scalar  double") == 1);
    CHECK(rows("scalar  single") == 1);
    CHECK(rows("packet  double") == supported);
    CHECK(rows("packet  single") == supported + 1);
    const std::vector<IsaInfo> isas = list_isas();
    if (isas.front().lanes_single == 1 && isas.front().supported && supported > 1)
        CHECK_THAT(result.out, ContainsSubstring(" lanes are ") &&
                                   ContainsSubstring(
                                       " times as fast as the same kernels with one, which are "));
    CHECK(read_image(folder / "out/four_spheres.png").width == 64);
    CHECK_THAT(result.out, ContainsSubstring((folder / "out/four_spheres.png").string()));
}

TEST_CASE("a long render shows its progress on a terminal only", "[cli][slow]")
{
    const TempFolder folder;
    const Words words{"render",      four_spheres, "-o",        folder / "a.png",
                      "--size",      "1200x1200",  "--kernel",  "scalar",
                      "--precision", "extended",   "--threads", "1"};
    const ProgramResult piped = run_packtrace(words);
    CHECK(is_one_line(piped.err));
    CHECK(piped.err.find('\r') == std::string::npos);

    const std::string shown = test::run_on_terminal(words);
    CHECK_THAT(shown, ContainsSubstring("\r[####"));
    CHECK_THAT(shown, ContainsSubstring(" %"));
    // The bar is cleared before the summary.
    CHECK_THAT(shown,
               ContainsSubstring("\r\033[K" + (folder / "a.png").string() + ": 1200 x 1200"));

    Words quiet = words;
    quiet.push_back("--quiet");
    CHECK(test::run_on_terminal(quiet).empty());
}

}  // namespace packtrace
