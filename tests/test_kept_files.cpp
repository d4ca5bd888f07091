// A command never overwrites its own input or its other output. Options without an effect are
// refused.
#include "catch.hpp"
#include "run_program.hpp"
#include "temp_folder.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

const std::string desk_scene =
    "image_size = 8 x 8\n"
    "sphere { center = (0, 0, 5) radius = 1 }\n"
    "light { type = point position = (0, 9, 0) intensity = 1 }\n";
const std::string desk_rays = "0,0,0,0,0,1\n";

using Words = std::vector<std::string>;

/// A folder with a scene, rays, a picture and a link to the picture.
class Desk {
public:
    Desk()
    {
        write_text(folder_ / "a.scene", desk_scene);
        write_text(folder_ / "rays.csv", desk_rays);
        REQUIRE(run_packtrace({"render", at("a.scene"), "-o", at("a.pfm")}).exit_code == 0);
        std::filesystem::create_symlink("a.pfm", folder_ / "link.pfm");
    }

    [[nodiscard]] std::string at(const std::string& name) const
    {
        return (folder_ / name).string();
    }

    /// Checks that the command is refused in one line with `reason`, and changes no file.
    void check_refused(const Words& words, const std::string& reason) const
    {
        const std::vector<std::string> names = folder_.names();
        const std::string picture = read_text(folder_ / "a.pfm");
        const ProgramResult result = run_packtrace(words);
        INFO(words[0] << ": " << result.err);
        CHECK(result.exit_code != 0);
        CHECK(result.out.empty());
        CHECK_THAT(result.err, ContainsSubstring(reason));
        CHECK(result.err.find('\n') == result.err.size() - 1);
        CHECK(folder_.names() == names);
        CHECK(read_text(folder_ / "a.scene") == desk_scene);
        CHECK(read_text(folder_ / "rays.csv") == desk_rays);
        CHECK(read_text(folder_ / "a.pfm") == picture);
    }

private:
    TempFolder folder_;
};

}  // namespace

TEST_CASE("no output replaces an input of the command", "[kept_files]")
{
    const Desk desk;
    const std::string scene = desk.at("a.scene");
    const std::string rays = desk.at("rays.csv");
    const std::string picture = desk.at("a.pfm");
    const std::string reason = "is read by this command";
    desk.check_refused({"intersect", scene, rays, "-o", rays}, reason);
    desk.check_refused({"intersect", scene, rays, "-o", scene}, reason);
    desk.check_refused({"intersect", scene, rays, "-o", rays, "--resume"}, reason);
    desk.check_refused({"compare", picture, picture, "--heatmap", desk.at("link.pfm")}, reason);
    desk.check_refused({"join", rays, "-o", rays}, reason);
    desk.check_refused({"bench", scene, "-o", scene}, reason);
    desk.check_refused({"bench", scene, "--baseline", rays, "-o", rays}, reason);
    std::filesystem::copy_file(scene, desk.at("b.png"));
    desk.check_refused({"demo", desk.at("b.png"), "-o", desk.at("")}, reason);
    CHECK(read_text(desk.at("b.png")) == desk_scene);
}

TEST_CASE("no two outputs of a command are one file", "[kept_files]")
{
    const Desk desk;
    const std::string scene = desk.at("a.scene");
    const std::string reason = "is written twice by this command";
    desk.check_refused(
        {"render", scene, "-o", desk.at("a.pfm"), "--certainty", desk.at("link.pfm")}, reason);
    desk.check_refused(
        {"render", scene, "-o", desk.at("new.pfm"), "--certainty", desk.at("./new.pfm")}, reason);
    desk.check_refused(
        {"profile", scene, "--heatmap", desk.at("new.png"), "--trace", desk.at("new.png")}, reason);
    // Two different names too long for any file do not count as one file.
    desk.check_refused({"render", scene, "-o", desk.at(std::string(300, 'a') + ".pfm"),
                        "--certainty", desk.at(std::string(300, 'b') + ".pfm")},
                       "File name too long");
}

TEST_CASE("a file beside the output that is not of an earlier run is left alone", "[kept_files]")
{
    const Desk desk;
    write_text(desk.at("b.png.part"), "mine");
    desk.check_refused({"render", desk.at("a.scene"), "-o", desk.at("b.png"), "--resume"},
                       "is in the way of --resume");
    CHECK(read_text(desk.at("b.png.part")) == "mine");
}

TEST_CASE("options without an effect are refused", "[kept_files]")
{
    const Desk desk;
    const std::string scene = desk.at("a.scene");
    const std::vector<std::pair<Words, std::string>> idle{
        {{"render", scene, "-o", desk.at("b.png"), "--fps", "24"}, "--fps"},
        {{"render", scene, "-o", desk.at("b.png"), "--y4m"}, "is the name of a picture"},
        {{"bench", scene, "--max-slowdown", "5%"}, "--max-slowdown"},
        {{"bench", scene, "-o", desk.at("none/b.json")}, "can't write"},
        {{"soak", scene, "--first", "3"}, "--first"},
        {{"stress", "--kernel", "scalar", "--isa", "one_lane"}, "only packets have them"},
        {{"info", scene, "--keys", "all"}, "--keys"},
        {{"intersect", scene, desk.at("rays.csv"), "--self-hits", "note"}, "--self-hits"}};
    for (const auto& [words, reason] : idle)
        desk.check_refused(words, reason);
}

}  // namespace packtrace::test
