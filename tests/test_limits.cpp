// Input that asks for too much is refused at once, in one line.
#include "catch.hpp"
#include "run_program.hpp"

#include <algorithm>

namespace packtrace::test {
namespace {

void check_refused(const std::vector<std::string>& words, int exit_code)
{
    const ProgramResult result = run_packtrace(words);
    CAPTURE(words, result.err);
    CHECK(result.exit_code == exit_code);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(result.err.size() < 400);
}

const std::string billions = "1000000000000";
const std::string one_sphere = "sphere { center = (0, 0, 3) radius = 1 }\n";

}  // namespace

TEST_CASE("options that ask for 10^12 of anything are refused", "[limits]")
{
    const std::string& scene = four_spheres_file;
    check_refused({"render", scene, "--size", billions + "x1", "-o", "x.png"}, 2);
    for (const char* const option : {"--spp", "--depth", "--threads"})
        check_refused({"render", scene, option, billions, "-o", "x.png"}, 2);
    check_refused({"generate", "random", "--count", billions, "-o", "x.scene"}, 2);
    check_refused({"stress", "--rays", billions}, 2);
    check_refused({"soak", "--scenes", billions}, 2);
}

TEST_CASE("scenes beyond their limits are refused before they take memory", "[limits]")
{
    const TempFolder folder;
    const std::string file = (folder / "a.scene").string();
    std::string deep;
    for (int i = 0; i < 5000; ++i)
        deep += "sphere { ";
    for (const std::string& text :
         {"image_size = " + billions + " x 1\n" + one_sphere,
          "max_depth = " + billions + "\n" + one_sphere, deep, std::string(1200000, 'a')}) {
        write_text(file, text);
        check_refused({"info", file}, 1);
    }
}

TEST_CASE("pictures and rays beyond their limits are refused before they take memory", "[limits]")
{
    const TempFolder folder;
    const std::string picture = (folder / "a.pfm").string();
    write_text(picture, "PF\n1000000000 1000000000\n-1\n");
    check_refused({"compare", picture, picture}, 1);
    const std::string rays = (folder / "a.csv").string();
    write_text(rays, std::string(2000000, '1'));
    check_refused({"intersect", four_spheres_file, rays}, 1);
    check_refused({"onedim", rays}, 1);
}

}  // namespace packtrace::test
