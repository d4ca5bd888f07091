// render --resume: interrupted pictures.
#include "catch.hpp"
#include "killed_program.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

using Words = std::vector<std::string>;

/// A folder with a scene whose picture has eight bands.
class Studio {
public:
    Studio()
    {
        write_text(folder / "one.scene", scene("200"));
        write_text(folder / "other.scene", scene("201"));
    }

    [[nodiscard]] Words words(const std::string& picture, const Words& more = {"--resume"},
                              const std::string& scene = "one.scene") const
    {
        Words all{"render", (folder / scene).string(),  "--size", "500x8300",
                  "-o",     (folder / picture).string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    [[nodiscard]] ProgramResult render(const std::string& picture, const Words& more = {"--resume"},
                                       const std::string& scene = "one.scene") const
    {
        return run_packtrace(words(picture, more, scene));
    }

    /// Kills a run with --resume once it has finished `bands`, and checks that it was not done.
    /// With one thread there is enough time.
    void interrupt(const std::string& picture, long bands, int signal = SIGKILL) const
    {
        Words all = words(picture, {"--resume", "--threads", "1"});
        all.insert(all.begin(), PACKTRACE_CLI);
        const auto part = folder / (picture + ".part");
        // The picture's file is created after the head of its journal.
        const int status = kill_program(all, signal, [&] {
            return lines_of(folder / (picture + ".journal")) >= 2 + bands &&
                   std::filesystem::exists(part);
        });
        REQUIRE(WIFSIGNALED(status));
        REQUIRE(std::filesystem::exists(part));
    }

    [[nodiscard]] bool same(const std::string& a, const std::string& b) const
    {
        return read_text(folder / a) == read_text(folder / b);
    }

    TempFolder folder;

private:
    static std::string scene(const std::string& red)
    {
        return "sphere { center = (0, 0, 3)  radius = 1  color = (" + red +
               ", 40, 30) }\nlight { type = ambient  intensity = 0.5 }\n"
               "light { type = point  intensity = 0.5  position = (2, 3, -1) }\n";
    }
};

}  // namespace

TEST_CASE("a resumed picture is the one that was not interrupted", "[resume]")
{
    for (const std::string ending : {".png", ".pfm", ".hdr"}) {
        CAPTURE(ending);
        const Studio studio;
        REQUIRE(studio.render("whole" + ending, {"-q"}).exit_code == 0);
        for (const long bands : {0L, 1L, 3L}) {
            const std::string picture = "a" + std::to_string(bands) + ending;
            studio.interrupt(picture, bands);
            CHECK_FALSE(std::filesystem::exists(studio.folder / picture));
            const ProgramResult result = studio.render(picture);
            CHECK(result.exit_code == 0);
            if (bands > 0)
                CHECK_THAT(result.err, ContainsSubstring("bands were finished by an earlier run"));
            CHECK(studio.same(picture, "whole" + ending));
            CHECK_FALSE(std::filesystem::exists(studio.folder / (picture + ".part")));
            CHECK_FALSE(std::filesystem::exists(studio.folder / (picture + ".journal")));
        }
        // The folder has no temporary file either.
        CHECK(studio.folder.names().size() == 2 + 4);
    }
}

TEST_CASE("an uninterrupted run with --resume leaves only the picture", "[resume]")
{
    const Studio studio;
    CHECK(studio.render("a.png", {"-q", "--resume", "--spp", "2"}).exit_code == 0);
    CHECK(studio.render("b.png", {"-q", "--spp", "2"}).exit_code == 0);
    CHECK(studio.same("a.png", "b.png"));
    CHECK((studio.folder.names() == Words{"a.png", "b.png", "one.scene", "other.scene"}));
}

TEST_CASE("an interrupted picture reports how far it came", "[resume]")
{
    const Studio studio;
    const std::string picture = (studio.folder / "a.png").string();
    studio.interrupt("a.png", 1, SIGINT);
    CHECK((studio.folder.names() ==
           Words{"a.png.journal", "a.png.part", "one.scene", "other.scene"}));
    CHECK(studio.render("a.png").exit_code == 0);
}

TEST_CASE("a picture begun with other options is not continued", "[resume]")
{
    struct Other {
        Words words;
        std::string scene;
        std::string message;
    };
    const std::vector<Other> others = {
        {{"--resume"}, "other.scene", "was begun with another scene"},
        {{"--resume", "--depth", "0"},
         "one.scene",
         "was begun with --depth 3; now with --depth 0;"},
        {{"--resume", "--spp", "2"}, "one.scene", "was begun with --spp 1; now with --spp 2;"},
        {{"--resume", "--precision", "double", "--gamma", "2.2"},
         "one.scene",
         "was begun with --precision single, with --gamma 1; now with --precision double, "
         "with --gamma 2.2;"},
        {{"--resume", "--adaptive", "0.1", "--spp", "4"},
         "one.scene",
         "was begun with --spp 1, without --adaptive; now with --spp 4, with --adaptive 0.1;"},
        {{"--resume", "--kernel", "scalar"},
         "one.scene",
         "was begun with --kernel packet, with --isa with FMA; now with --kernel scalar, without "
         "--isa;"},
    };
    const Studio studio;
    studio.interrupt("a.png", 1);
    const std::string journal = read_text(studio.folder / "a.png.journal");
    for (const Other& other : others) {
        CAPTURE(other.words, other.scene);
        const ProgramResult result = studio.render("a.png", other.words, other.scene);
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.err, ContainsSubstring("a.png.journal: " + other.message));
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
        CHECK(read_text(studio.folder / "a.png.journal") == journal);
    }
    std::string older = journal;
    older.replace(older.find("packtrace ", 10), 11, "packtrace 9");
    write_text(studio.folder / "a.png.journal", older);
    CHECK_THAT(studio.render("a.png").err, ContainsSubstring("was begun with another version"));
    write_text(studio.folder / "a.png.journal", "four eggs\n");
    CHECK_THAT(studio.render("a.png").err, ContainsSubstring("is not a journal"));
}

TEST_CASE("damaged and truncated bands are rendered again", "[resume]")
{
    const Studio studio;
    REQUIRE(studio.render("whole.pfm", {"-q"}).exit_code == 0);
    studio.interrupt("a.pfm", 2);
    const std::string journal = read_text(studio.folder / "a.pfm.journal");
    const std::string part = read_text(studio.folder / "a.pfm.part");
    for (std::size_t cut = 0; cut < 30; cut += 3) {
        CAPTURE(cut);
        write_text(studio.folder / "a.pfm.journal", journal.substr(0, journal.size() - cut));
        write_text(studio.folder / "a.pfm.part", part);
        CHECK(studio.render("a.pfm").exit_code == 0);
        CHECK(studio.same("a.pfm", "whole.pfm"));
    }
    for (const std::size_t kept : {std::size_t{0}, std::size_t{100}, part.size() - 100}) {
        write_text(studio.folder / "a.pfm.journal", journal);
        write_text(studio.folder / "a.pfm.part", part.substr(0, kept));
        CHECK(studio.render("a.pfm").exit_code == 0);
        CHECK(studio.same("a.pfm", "whole.pfm"));
    }
    std::string changed = part;
    changed.back() = static_cast<char>(changed.back() ^ 1);
    write_text(studio.folder / "a.pfm.journal", journal);
    write_text(studio.folder / "a.pfm.part", changed);
    CHECK(studio.render("a.pfm").exit_code == 0);
    CHECK(studio.same("a.pfm", "whole.pfm"));
}

TEST_CASE("a journal that ends within its head is ignored", "[resume]")
{
    const Studio studio;
    REQUIRE(studio.render("whole.png", {"-q"}).exit_code == 0);
    studio.interrupt("a.png", 0);
    const std::string journal = read_text(studio.folder / "a.png.journal");
    std::filesystem::remove(studio.folder / "a.png.part");
    const std::size_t head = journal.find('\n', journal.find('\n') + 1);
    for (const std::size_t kept : {std::size_t{0}, std::size_t{5}, head - 40, head}) {
        CAPTURE(kept);
        write_text(studio.folder / "a.png.journal", journal.substr(0, kept));
        CHECK(studio.render("a.png").exit_code == 0);
        CHECK(studio.same("a.png", "whole.png"));
        CHECK((studio.folder.names() == Words{"a.png", "one.scene", "other.scene", "whole.png"}));
    }
}

TEST_CASE("runs that begin and end at once leave one whole picture and no journal", "[resume]")
{
    const TempFolder folder;
    const TempFolder errors;
    const std::string run =
        shell_quoted(PACKTRACE_CLI) + " render " + shell_quoted(four_spheres_file) +
        " --size 16x16 --threads 1 -q --resume -o " + shell_quoted((folder / "a.png").string());
    // Each of many shells starts run after run, so that some begin as others end.
    const std::string each = "for run in $(seq 20); do " + run + "; echo exit $?; done";
    const ProgramResult all = run_command(
        {"sh", "-c",
         "for shell in $(seq 16); do (" + each + ") >" + shell_quoted((errors / "").string()) +
             "$shell 2>&1 & done; wait; cat " + shell_quoted((errors / "").string()) + "*"});
    std::istringstream lines(all.out);
    int finished = 0;
    int refused = 0;
    for (std::string line; std::getline(lines, line);) {
        CAPTURE(line);
        const bool is_refusal = line.ends_with(
            "a.png.journal: another run is at work on this output; wait for it or end it");
        finished += line == "exit 0" ? 1 : 0;
        refused += is_refusal ? 1 : 0;
        CHECK((is_refusal || line == "exit 0" || line == "exit 1"));
    }
    CHECK(finished > 0);
    CHECK(finished + refused == 16 * 20);
    CHECK(folder.names() == Words{"a.png"});
}

TEST_CASE("--resume is refused where no journal can be kept", "[resume]")
{
    const Studio studio;
    const ProgramResult frames = studio.render("%d.png", {"--resume", "--frames", "0..1"});
    CHECK(frames.exit_code == 2);
    CHECK_THAT(frames.err, ContainsSubstring("--resume: is for one picture"));
    std::filesystem::create_symlink("/dev/null", studio.folder / "null.png");
    const ProgramResult device = studio.render("null.png");
    CHECK(device.exit_code == 1);
    CHECK_THAT(device.err, ContainsSubstring("is no regular file"));
    // A link to a pipe that has no name.
    write_text(studio.folder / "rays", "0,0,0,0,0,1\n");
    const std::string intersect = shell_quoted(PACKTRACE_CLI) + " intersect " +
                                  shell_quoted(four_spheres_file) + " " +
                                  shell_quoted((studio.folder / "rays").string());
    const ProgramResult pipe =
        run_command({"sh", "-c", intersect + " -o /dev/stdout --resume | cat"});
    CHECK_THAT(pipe.err, ContainsSubstring("/dev/stdout: --resume: is no regular file"));
    // A link to a file that has one, on another disk than the link.
    const std::string hits = (studio.folder / "hits.csv").string();
    const ProgramResult file =
        run_command({"sh", "-c", intersect + " -o /dev/stdout --resume >" + shell_quoted(hits)});
    CHECK(file.exit_code == 0);
    CHECK(read_text(hits).starts_with("hit,t,"));
}

TEST_CASE("pictures killed at random moments are resumed to the same bytes", "[resume][slow]")
{
    const Studio studio;
    REQUIRE(studio.render("whole.hdr", {"-q"}).exit_code == 0);
    std::uint32_t random = 1;
    for (int i = 0; i < 50; ++i) {
        Words all = studio.words("a.hdr", {"--resume", "--threads", "1"});
        all.insert(all.begin(), PACKTRACE_CLI);
        random = random * 1664525u + 1013904223u;
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(random >> 23);
        (void)kill_program(all, i % 2 == 0 ? SIGKILL : SIGTERM,
                           [&] { return std::chrono::steady_clock::now() > end; });
        if (i % 4 != 3)
            continue;
        CHECK(studio.render("a.hdr").exit_code == 0);
        CHECK(studio.same("a.hdr", "whole.hdr"));
        CHECK(studio.folder.names().size() == 4);
    }
}

}  // namespace packtrace::test
