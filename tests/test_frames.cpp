// render --frame, --frames and --y4m.
#include "catch.hpp"
#include "core/text.hpp"
#include "image/y4m.hpp"
#include "run_program.hpp"
#include <packtrace/animate.hpp>
#include <packtrace/image_io.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <filesystem>
#include <vector>

namespace packtrace::test {
namespace {

using Words = std::vector<std::string>;

const char* const turning =
    "image_size = 19 x 13\n"
    "camera { position = (0, 0, -2)  look_at = (0, 0, 3) }\n"
    "animation { frames = 5  orbit { center = (0, 0, 3) } }\n"
    "sphere { center = (0, 0, 3)    radius = 1    color = (200, 40, 30) }\n"
    "sphere { center = (1.5, 0, 3)  radius = 0.4  color = (30, 200, 40) }\n"
    "light { type = ambient  intensity = 0.5 }\n"
    "light { type = point  intensity = 0.5  position = (2, 3, -1) }\n";

/// A folder that contains turning.scene.
class Studio {
public:
    Studio() : scene_(folder / "turning.scene")
    {
        write_text(scene_, turning);
        write_text(folder / "still.scene", "sphere { center = (0, 0, 3) radius = 1 }");
    }

    [[nodiscard]] ProgramResult render(const std::string& output, const Words& more,
                                       const std::string& scene = "turning.scene") const
    {
        Words words{"render", folder / scene, "-o",
                    output == "-" ? output : (folder / output).string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_packtrace(words);
    }

    [[nodiscard]] Image<float> frame(int number) const
    {
        Scene scene = read_scene(scene_);
        scene.camera = camera_at(scene, number);
        return packtrace::render<float>(scene);
    }

    TempFolder folder;

private:
    std::filesystem::path scene_;
};

std::string video_of(const Studio& studio, int first, int last)
{
    std::string bytes = y4m_header(19, 13, {});
    for (int number = first; number <= last; ++number) {
        const Bytes frame = y4m_frame(studio.frame(number));
        bytes.append(frame.begin(), frame.end());
    }
    return bytes;
}

}  // namespace

TEST_CASE("--frames writes each frame as its camera sees it", "[frames]")
{
    const Studio studio;
    const ProgramResult result = studio.render("f%02d.pfm", {"--frames", "1..3"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.err, ContainsSubstring("3 frames rendered in "));
    CHECK_THAT(result.err, ContainsSubstring("; written in "));
    CHECK((studio.folder.names() == Words{"f01.pfm", "f01.pfm.recipe", "f02.pfm", "f02.pfm.recipe",
                                          "f03.pfm", "f03.pfm.recipe", "still.scene",
                                          "turning.scene"}));
    for (const int number : {1, 2, 3}) {
        const std::string name = "f0" + std::to_string(number) + ".pfm";
        CHECK((read_image(studio.folder / name).rgb == studio.frame(number).rgb));
    }
    CHECK((studio.frame(1).rgb != studio.frame(2).rgb));
}

TEST_CASE("--frames continues where it stopped, --overwrite starts again", "[frames]")
{
    for (const std::string ending : {".png", ".pfm", ".hdr"}) {
        CAPTURE(ending);
        const Studio studio;
        CHECK(studio.render("f%d" + ending, {"--frames", "1..1"}).exit_code == 0);
        const std::string first = read_text(studio.folder / ("f1" + ending));
        const ProgramResult result = studio.render("f%d" + ending, {"--frames", "0..2"});
        CHECK(result.exit_code == 0);
        CHECK_THAT(result.err, ContainsSubstring("2 frames rendered"));
        CHECK_THAT(result.err, ContainsSubstring("1 were there already"));
        CHECK_THAT(result.err, !ContainsSubstring("in place of"));
        CHECK(read_text(studio.folder / ("f1" + ending)) == first);

        const ProgramResult again =
            studio.render("f%d" + ending, {"--frames", "0..2", "--overwrite"});
        CHECK(again.exit_code == 0);
        CHECK_THAT(again.err, ContainsSubstring("3 frames rendered"));
        CHECK(read_text(studio.folder / ("f1" + ending)) == first);
    }
}

TEST_CASE("--frames renders frames of another scene or of other options again", "[frames]")
{
    // The words that each run adds to the command line, and how many of frames 0..1 it renders.
    struct Run {
        const char* why;
        Words words;
        std::string scene;
        int rendered;
    };
    const std::string s = "turning.scene";
    const std::vector<Run> runs = {
        {"none is there", {}, s, 2},
        {"no pixel depends on threads", {"--threads", "1"}, s, 0},
        {"nor on how objects are found", {"--traversal", "tree"}, s, 0},
        {"nor on comments", {}, "commented.scene", 0},
        {"another size", {"--size", "9x5"}, s, 2},
        {"the size of the scene again", {}, s, 2},
        {"more samples", {"--spp", "4"}, s, 2},
        {"fewer again", {}, s, 2},
        {"another depth", {"--depth", "0"}, s, 2},
        {"rays of little weight cut", {"--min-weight", "0.1"}, s, 2},
        {"another precision", {"--precision", "double"}, s, 2},
        {"another kernel", {"--kernel", "scalar", "--precision", "double"}, s, 2},
        {"starts as the notes have them", {"--self-hits", "note"}, s, 2},
        {"another scene", {"--self-hits", "note"}, "redder.scene", 2},
    };
    for (const std::string ending : {".png", ".pfm"}) {
        const Studio studio;
        const std::string text = turning;
        write_text(studio.folder / "commented.scene", "# the same\n" + text);
        std::string redder = text;
        redder.replace(redder.find("(200, 40, 30)"), 13, "(201, 40, 30)");
        write_text(studio.folder / "redder.scene", redder);
        for (const Run& run : runs) {
            CAPTURE(ending, run.why);
            Words words{"--frames", "0..1"};
            words.insert(words.end(), run.words.begin(), run.words.end());
            const ProgramResult result = studio.render("f%d" + ending, words, run.scene);
            CHECK(result.exit_code == 0);
            CHECK_THAT(result.err, ContainsSubstring(counted(run.rendered, "frame") + " rendered"));
            if (run.rendered == 0)
                CHECK_THAT(result.err, ContainsSubstring("2 were there already"));
            else if (&run != &runs.front())
                CHECK_THAT(result.err,
                           ContainsSubstring("2 in place of pictures of another scene"));
        }
    }
}

TEST_CASE("--frames renders damaged and replaced pictures again", "[frames]")
{
    for (const std::string ending : {".png", ".pfm"}) {
        CAPTURE(ending);
        const Studio studio;
        write_text(studio.folder / ("f0" + ending), "finished");
        const ProgramResult first = studio.render("f%d" + ending, {"--frames", "0..1"});
        CHECK_THAT(first.err, ContainsSubstring("2 frames rendered"));
        CHECK_THAT(first.err, ContainsSubstring("1 in place of pictures"));
        const std::string frame = read_text(studio.folder / ("f0" + ending));
        CHECK(frame != "finished");
        // A single frame under a plain name has no record of what made it.
        CHECK(studio.render("f0" + ending, {"--frame", "3", "-q"}).exit_code == 0);
        const ProgramResult second = studio.render("f%d" + ending, {"--frames", "0..1"});
        CHECK_THAT(second.err, ContainsSubstring("1 frame rendered"));
        CHECK_THAT(second.err, ContainsSubstring("1 were there already"));
        CHECK(read_text(studio.folder / ("f0" + ending)) == frame);
    }
}

TEST_CASE("a frame that can't be written ends the run and leaves no unfinished file", "[frames]")
{
    const Studio studio;
    std::filesystem::create_directory(studio.folder / "f1.pfm");
    const ProgramResult result = studio.render("f%d.pfm", {"--frames", "0..2"});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, ContainsSubstring("f1.pfm: can't write"));
    CHECK((studio.folder.names() ==
           Words{"f0.pfm", "f0.pfm.recipe", "f1.pfm", "still.scene", "turning.scene"}));
}

TEST_CASE("a frame without a view is reported before the first frame is rendered", "[frames]")
{
    const Studio studio;
    write_text(studio.folder / "through.scene",
               "sphere { center = (0, 0, 9)  radius = 1 }\n"
               "animation { frames = 3\n"
               "key { frame = 0  position = (0, 0, 0)  look_at = (0, 0, 3) }\n"
               "key { frame = 2  position = (0, 0, 6)  look_at = (0, 0, 3) } }\n");
    for (const Words& frames : {Words{"--frames", "0..2"}, Words{"--y4m"}}) {
        const std::string output = frames[0] == "--y4m" ? "film.y4m" : "f%d.png";
        const ProgramResult result = studio.render(output, frames, "through.scene");
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, ContainsSubstring("frame 1: the way between"));
    }
    CHECK(studio.folder.names().size() == 3);
}

TEST_CASE("--frame renders one frame under a plain name", "[frames]")
{
    const Studio studio;
    CHECK(studio.render("one.pfm", {"--frame", "3", "-q"}).exit_code == 0);
    CHECK((read_image(studio.folder / "one.pfm").rgb == studio.frame(3).rgb));
}

TEST_CASE("--y4m sends a video to standard output or into a file", "[frames]")
{
    const Studio studio;
    const ProgramResult piped = studio.render("-", {"--y4m"});
    CHECK(piped.exit_code == 0);
    CHECK((piped.out == video_of(studio, 0, 4)));
    CHECK_THAT(piped.err, ContainsSubstring("5 frames rendered"));
    CHECK(studio.render("v.y4m", {"--y4m", "--frames", "1..2", "-q"}).exit_code == 0);
    CHECK((read_text(studio.folder / "v.y4m") == video_of(studio, 1, 2)));
    CHECK_THAT(studio.render("-", {"--y4m", "--fps", "12"}).out, ContainsSubstring("H13 F12:1 Ip"));
}

TEST_CASE("a video that can't be written is an error", "[frames]")
{
    const Studio studio;
    const ProgramResult result = studio.render("none/v.y4m", {"--y4m"});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, ContainsSubstring("v.y4m: can't write"));
}

TEST_CASE("wrong use of frame options exits with 2 and one line", "[frames]")
{
    struct Wrong {
        std::string output;
        Words words;
        std::string scene;
        std::string message;
    };
    const std::string s = "turning.scene";
    const std::vector<Wrong> wrongs = {
        {"a.png", {"--frames", "0..4"}, s, "has no place for the frame's number"},
        {"%d%d.png", {"--frames", "0..4"}, s, "has two places for the frame's number"},
        {"%x.png", {"--frames", "0..4"}, s, "has a % that is no %d"},
        {"%d.png",
         {"--frames", "0..5"},
         s,
         "frames 0..5 are not all in the animation, which has 0..4"},
        {"%d.png", {"--frames", "4..1"}, s, "ends before it begins"},
        {"%d.png", {"--frames", "1-4"}, s, "is not a range of frames"},
        {"%d.png", {"--frames", "0..1"}, "still.scene", "--frames: the scene has no animation"},
        {"-", {"--y4m"}, "still.scene", "--y4m: the scene has no animation"},
        {"a.mp4", {"--y4m"}, s, "--y4m: writes YUV4MPEG2, not .mp4; write it to -"},
        {"a.png", {"--frame", "0"}, "still.scene", "--frame: the scene has no animation"},
        {"a.png", {"--frame", "5"}, s, "frame 5 is none of the animation's, 0..4"},
        {"%d.png", {"--frame", "1", "--frames", "0..1"}, s, "--frame: one frame only"},
        {"a.png", {"--overwrite"}, s, "--overwrite: only --frames"},
    };
    const Studio studio;
    for (const Wrong& wrong : wrongs) {
        CAPTURE(wrong.output, wrong.words);
        const ProgramResult result = studio.render(wrong.output, wrong.words, wrong.scene);
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, ContainsSubstring(wrong.message));
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
        CHECK(result.out.empty());
    }
    CHECK((studio.folder.names() == Words{"still.scene", "turning.scene"}));
}

}  // namespace packtrace::test
