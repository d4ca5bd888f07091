// The command `explain`.
#include "catch.hpp"
#include "explain_trees.hpp"
#include "render_scene.hpp"
#include "run_program.hpp"
#include "scenes.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <sstream>

namespace packtrace::test {
namespace {

ProgramResult explain(const std::vector<std::string>& more)
{
    std::vector<std::string> words{"explain", four_spheres_file, "--size", "40x30"};
    words.insert(words.end(), more.begin(), more.end());
    return run_packtrace(words);
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// The line that starts with `label`, without its indent.
std::string line_of(const std::string& text, const std::string& label)
{
    const std::size_t at = text.find(label);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

/// The words between spaces and commas, from the table's head on.
std::vector<std::string> table_words(const std::string& text)
{
    const std::size_t head = text.find("reference   ");
    const std::size_t end = text.find("no difference", head);
    REQUIRE(end != std::string::npos);
    std::string table = text.substr(head, end - head);
    std::replace(table.begin(), table.end(), ',', ' ');
    std::istringstream words(table);
    return {std::istream_iterator<std::string>(words), {}};
}

/// Equal words, or numbers that are nearly equal: the last digit depends on the instruction set.
bool is_alike(const std::string& a, const std::string& b)
{
    char* end = nullptr;
    const double x = std::strtod(a.c_str(), &end);
    if (a == b || end != a.c_str() + a.size())
        return a == b;
    const double y = std::strtod(b.c_str(), &end);
    return end == b.c_str() + b.size() && std::abs(x - y) <= 2e-6 * std::max(1.0, std::abs(x));
}

}  // namespace

TEST_CASE("explain prints the example of docs/explain.md", "[explain_cli]")
{
    const auto page = table_words(read_text(PACKTRACE_SOURCE_DIR "/docs/explain.md"));
    const auto printed = table_words(explain({"--pixel", "30,20", "--depth", "1"}).out);
    CHECK(printed.size() > 100);
    REQUIRE(page.size() == printed.size());
    for (std::size_t i = 0; i < page.size(); ++i) {
        CAPTURE(page[i], printed[i]);
        CHECK(is_alike(page[i], printed[i]));
    }
}

TEST_CASE("explain prints both trees beside each other", "[explain_cli]")
{
    const ProgramResult result = explain({"--pixel", "20,15"});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    CHECK(has(result.out, "pixel 20,15 of 40 x 30\n"));
    CHECK(has(result.out, "\ncamera ray\n"));
    CHECK(has(result.out, "\n  mirrored ray\n"));
    const std::string object = line_of(result.out, "object ");
    CHECK(has(object, "sphere"));
    CHECK(object.find("sphere") != object.rfind("sphere"));
    CHECK(has(result.out, "no difference beyond 0.0001\n"));
    CHECK_FALSE(has(result.out, "<--"));
}

TEST_CASE("explain marks only the first difference", "[explain_cli]")
{
    // The ray of the canvas point (-0.4, 0.1) touches the blue sphere to the last digit. Kernels
    // without fused multiply-add miss it through rounding; on Arm all kernels have fused
    // multiply-add.
    const std::vector<std::string> isas = supported_isas();
    if (std::find(isas.begin(), isas.end(), "sse42") == isas.end())
        return;
    const ProgramResult result =
        run_packtrace({"explain", four_spheres_file, "--size", "10x10", "--pixel", "1,3",
                       "--precision", "double", "--isa", "sse42"});
    CHECK(result.exit_code == 0);
    const std::size_t mark = result.out.find("<-- first difference");
    REQUIRE(mark != std::string::npos);
    CHECK(result.out.find("<--", mark + 1) == std::string::npos);
    CHECK(has(result.out, "first difference beyond 1e-09: camera"));
}

TEST_CASE("explain gives both trees in JSON", "[explain_cli]")
{
    const ProgramResult result = explain({"--pixel", "20,15", "--json", "--precision", "double"});
    CHECK(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json["pixel"] == nlohmann::json{{"x", 20}, {"y", 15}});
    CHECK(json["width"] == 40);
    CHECK(json["precision"] == "double");
    CHECK(json["first_difference"].is_null());

    Scene scene = read_scene(four_spheres_file);
    set_size(scene, 40, 30);
    const RayNode tree = reference_tree(scene, 20, 15);
    for (const char* const side : {"reference", "packets"}) {
        const auto& root = json[side]["tree"];
        CHECK(root["kind"] == "camera");
        CHECK(root["object"] == scene.objects[static_cast<std::size_t>(tree.object)].name);
        CHECK(std::abs(root["t"].get<double>() - tree.t) <= 1e-9);
        CHECK(root["lights"].size() == tree.lights.size());
        REQUIRE(root["children"].size() == 1);
        CHECK(root["children"][0]["kind"] == "mirrored");
        CHECK(std::abs(json[side]["color"][0].get<double>() - sum_of(tree).x) <= 1e-9);
    }
}

TEST_CASE("explain takes the depth, the instruction set and the width", "[explain_cli]")
{
    const ProgramResult flat = explain({"--pixel", "20,15", "--depth", "0"});
    CHECK(flat.exit_code == 0);
    CHECK_FALSE(has(flat.out, "mirrored ray"));
    const IsaInfo narrow = list_isas().front();
    CHECK(has(explain({"--pixel", "1,1", "--isa", narrow.name}).out, narrow.name + ", single"));
    CHECK(explain({"--pixel", "1,1", "--width", "4"}).exit_code == 0);
    CHECK(explain({"--pixel", "1,1", "--width", "5"}).exit_code == 2);
}

TEST_CASE("explain takes the accuracy and the rule of self-hits", "[explain_cli]")
{
    const auto trees = [](const std::string& scene, const std::vector<std::string>& more) {
        std::vector<std::string> words{"explain", scene,   "--size", "40x30",
                                       "--pixel", "20,15", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramResult result = run_packtrace(words);
        CHECK(result.exit_code == 0);
        return nlohmann::json::parse(result.out);
    };
    // By the notes' rule, rays within thin glass start outside it.
    const std::string glass = PACKTRACE_SOURCE_DIR "/docs/numerics/pancake.scene";
    const auto exact = trees(glass, {"--precision", "double"});
    const auto note = trees(glass, {"--precision", "double", "--self-hits", "note"});
    CHECK(exact == trees(glass, {"--precision", "double", "--self-hits", "exact"}));
    for (const char* const side : {"reference", "packets"})
        CHECK(exact[side] != note[side]);
    CHECK(exact["first_difference"].is_null());
    CHECK(note["first_difference"].is_null());

    CHECK(trees(four_spheres_file, {"--accuracy", "fast"})["packets"] !=
          trees(four_spheres_file, {"--accuracy", "exact"})["packets"]);
    CHECK(explain({"--pixel", "1,1", "--accuracy", "most"}).exit_code == 2);
    const ProgramResult doubles =
        explain({"--pixel", "1,1", "--precision", "double", "--accuracy", "fast"});
    CHECK(doubles.exit_code == 2);
    // explain has no --kernel.
    CHECK_THAT(doubles.err, ContainsSubstring("leave it out or use --precision single;"));
}

TEST_CASE("explain names the picture's size for a pixel outside it", "[explain_cli]")
{
    for (const char* const pixel : {"40,0", "0,30", "99999,99999"}) {
        const ProgramResult result = explain({"--pixel", pixel});
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK_THAT(result.err, ContainsSubstring("40 x 30"));
    }
    CHECK(explain({"--pixel", "39,29"}).exit_code == 0);
}

TEST_CASE("explain refuses a malformed pixel and a missing scene", "[explain_cli]")
{
    for (const char* const pixel :
         {"", "3", "3,", ",3", "3x4", "-1,2", "1,-2", "1,2,3", "1, 2", "a,b", "99999999999,1"})
        CHECK(explain({std::string("--pixel=") + pixel}).exit_code == 2);
    CHECK(explain({}).exit_code == 2);
    CHECK(explain({"--pixel", "1,1", "--precision", "extended"}).exit_code == 2);
    CHECK(run_packtrace({"explain", "no such.scene", "--pixel", "1,1"}).exit_code == 1);
}

}  // namespace packtrace::test
