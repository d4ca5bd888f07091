#include "catch.hpp"
#include "intersect_program.hpp"
#include "render/ray_columns.hpp"
#include "render_scene.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// `packtrace intersect`: rays in, hits out.
namespace packtrace::test {
namespace {

using Words = std::vector<std::string>;

const std::string closest_header = "hit,t,object,nx,ny,nz\n";
const std::string all_header = "ray,t,object,nx,ny,nz\n";

// Each ray with its expected row; t in lengths of the direction.
const std::vector<std::pair<std::string, std::string>> hand_worked{
    {"0,0,0,0,0,1,0,inf", "1,4,ball,0,0,-1"},
    {"0,0,0,0,0,2,0,inf", "1,2,ball,0,0,-1"},
    {"0,0,0,0,-1,0,0,", "1,2,\"floor, tiled\",0,1,0"},
    {"0,0,0,0,1,0,0,inf", "0,,,,,"},
    // From inside the ball; its normals point outwards.
    {"0,0,5,0,0,2,0,inf", "1,0.5,ball,0,0,1"},
    {"0,0,5,0,4,0,,", "1,0.25,ball,0,1,0"},
    // The ray interval is open: a hit at its end does not count.
    {"0,0,0,0,0,1,4,inf", "1,6,ball,0,0,1"},
    {"0,0,0,0,0,1,3.875,inf", "1,4,ball,0,0,-1"},
    {"0,0,0,0,0,1,0,4", "0,,,,,"},
    {"0,0,0,0,0,1,0,4.125", "1,4,ball,0,0,-1"},
    {"0,0,0,0,0,1,6,inf", "0,,,,,"},
    {"0,0,0,0,0,1,5,3", "0,,,,,"},
    {"5,0,0,1,0,0,0,inf", "1,4,can,-1,0,0"},
    {"10.5,0,-5,0,0,0.5,0,inf", "1,8,can,0,0,-1"},
};

std::string hand_rays()
{
    std::string text = "ox,oy,oz,dx,dy,dz,t_min,t_max\n";
    for (const auto& [ray, row] : hand_worked)
        text += ray + "\n";
    return text;
}

std::string hand_rows()
{
    std::string text = closest_header;
    for (const auto& [ray, row] : hand_worked)
        text += row + "\n";
    return text;
}

std::string without_header(const std::string& text)
{
    return text.substr(text.find('\n') + 1);
}

// Random rays towards the ball, the floor and past them, and their text.
template <class Real>
struct RandomRays {
    RayColumns<Real> columns;
    std::string text;

    explicit RandomRays(int count)
    {
        std::mt19937 random(3);
        std::uniform_real_distribution<Real> place(-1, 1);
        for (int i = 0; i < count; ++i)
            add({place(random), place(random), place(random), place(random), place(random), 3, 0,
                 std::numeric_limits<Real>::infinity()});
    }

    void add(const std::array<Real, 8>& ray)
    {
        columns.add(ray);
        for (std::size_t i = 0; i < 6; ++i) {
            char digits[64];
            const auto end = std::to_chars(digits, digits + sizeof digits, ray[i]);
            text.append(digits, end.ptr);
            text += i < 5 ? ',' : '\n';
        }
    }
};

std::vector<std::string> fields_of(const std::string& row)
{
    std::vector<std::string> fields(1);
    for (const char c : row)
        if (c == ',')
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

// Every t that the library computes must be read back from the program's text, bit for bit.
template <class Real>
void check_round_trip(const std::string& precision)
{
    const RandomRays<Real> rays(5000);
    const ProgramResult result =
        intersect(rays.text, {"--precision", precision, "--isa", choose_isa().name});
    REQUIRE(result.exit_code == 0);
    const Scene scene = parse_scene(hand_scene, "hand.scene");
    std::vector<Real> t(5000);
    std::vector<std::int32_t> object(5000);
    RayScene<Real>(scene).closest_hits(rays.columns.view(), {t.data(), object.data()});

    std::istringstream rows(without_header(result.out));
    std::string row;
    std::size_t hits = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
        REQUIRE(std::getline(rows, row));
        REQUIRE(row.starts_with(object[i] < 0 ? "0," : "1,"));
        if (object[i] < 0)
            continue;
        ++hits;
        REQUIRE(std::stod(fields_of(row)[1]) == static_cast<double>(t[i]));
    }
    CHECK_FALSE(std::getline(rows, row));
    CHECK(hits > 1000);
    CHECK(hits < 5000);
}

std::string random_text(int count)
{
    return RandomRays<double>(count).text;
}

}  // namespace

TEST_CASE("rays worked out by hand get their exact rows", "[intersect_cli]")
{
    for (const std::string precision : {"double", "single"}) {
        const ProgramResult scalar =
            intersect(hand_rays(), {"--precision", precision, "--kernel", "scalar"});
        CHECK(scalar.out == hand_rows());
        CHECK(scalar.exit_code == 0);
        CHECK(scalar.err.empty());
        for (const std::string& isa : supported_isas()) {
            CAPTURE(isa, precision);
            const ProgramResult packets =
                intersect(hand_rays(), {"--precision", precision, "--isa", isa});
            CHECK(packets.out == hand_rows());
            CHECK(packets.exit_code == 0);
        }
    }
}

TEST_CASE("numbers are written so that reading them gives the same bits", "[intersect_cli]")
{
    check_round_trip<double>("double");
    check_round_trip<float>("single");
}

TEST_CASE("double is the default precision", "[intersect_cli]")
{
    const std::string rays = random_text(100);
    const std::string out = intersect(rays).out;
    CHECK(out == intersect(rays, {"--precision", "double"}).out);
    CHECK(out != intersect(rays, {"--precision", "single"}).out);
}

TEST_CASE("all hits of a ray come in order, with the ray's number from 0", "[intersect_cli]")
{
    const std::string rays =
        "10.5,0,-5,0,0,1\n"   // down the can, cap to cap
        "0,9,0,0,1,0\n"       // nothing
        "5,0,0,1,0,0\n"       // across the can
        "0,3,5,0,-1,0\n"      // through the ball to the floor
        "10,0,0,0,0,-0.5\n";  // from the can's middle
    const std::string rows = all_header +
                             "0,4,can,0,0,-1\n0,6,can,0,0,1\n"
                             "2,4,can,-1,0,0\n2,6,can,1,0,0\n"
                             "3,2,ball,0,1,0\n3,4,ball,0,-1,0\n3,5,\"floor, tiled\",0,1,0\n"
                             "4,2,can,0,0,-1\n";
    CHECK(intersect(rays, {"--all"}).out == rows);
    CHECK(intersect(rays, {"--all", "--kernel", "scalar"}).out == rows);
    CHECK(intersect(rays, {"--all", "--precision", "single"}).out == rows);
}

TEST_CASE("any says only whether a ray hits", "[intersect_cli]")
{
    std::string rows = "hit\n";
    for (const auto& [ray, row] : hand_worked)
        rows += row.substr(0, 1) + "\n";
    CHECK(intersect(hand_rays(), {"--any"}).out == rows);
    CHECK(intersect(hand_rays(), {"--any", "--kernel", "scalar"}).out == rows);
}

TEST_CASE("comments, blank lines, blanks, line ends and a byte order mark don't matter",
          "[intersect_cli]")
{
    const std::string rows = closest_header + "1,4,ball,0,0,-1\n0,,,,,\n";
    const Words same{
        "0,0,0,0,0,1\n0,0,0,0,1,0\n",
        "0,0,0,0,0,1\n0,0,0,0,1,0",
        "ox,oy,oz,dx,dy,dz\n0,0,0,0,0,1\n0,0,0,0,1,0\n",
        "\xEF\xBB\xBFox,oy,oz,dx,dy,dz\r\n0,0,0,0,0,1\r\n0,0,0,0,1,0\r\n",
        "# rays\n\n  \t\n  # a, comment\n ox , oy,oz,dx,dy,dz\n0, 0,\t0 "
        ",0,0,+1e0\n#\n0,0,0,0,1,0\n\n",
        "ox,oy,oz,dx,dy,dz,t_min,t_max\n0,0,0,0,0,1,0,inf\n0,0,0,0,1,0,0,infinity\n",
        "0,0,0,0,0,1,,\r\n\r\n0,0,0,0,1,0,0,\r\n",
    };
    for (const std::string& rays : same) {
        CAPTURE(rays);
        const ProgramResult result = intersect(rays);
        CHECK(result.out == rows);
        CHECK(result.err.empty());
    }
}

TEST_CASE("no rays give no rows", "[intersect_cli]")
{
    for (const std::string rays : {"", "\n", "# none", "ox,oy,oz,dx,dy,dz\n"}) {
        const ProgramResult result = intersect(rays);
        CHECK(result.out == closest_header);
        CHECK(result.exit_code == 0);
    }
}

TEST_CASE("rows keep the rays' order over blocks, kernels and threads", "[intersect_cli]")
{
    // Many blocks; the numbers in a --all listing identify the rays.
    const std::string rays = random_text(30000);
    const std::string rows = intersect(rays, {"--all", "--threads", "1"}).out;
    for (const std::string threads : {"2", "3", "8"})
        CHECK(intersect(rays, {"--all", "--threads", threads}).out == rows);
    CHECK(intersect(rays, {"--threads", "1"}).out == intersect(rays, {"--threads", "8"}).out);
    const std::string last = rows.substr(rows.rfind('\n', rows.size() - 2) + 1);
    CHECK(std::stoi(last) > 29990);

    // The closest hit is the first listed.
    const ProgramResult closest = intersect(rays);
    std::istringstream listed(without_header(rows));
    std::istringstream answers(without_header(closest.out));
    std::string hit;
    std::string row;
    std::getline(listed, hit);
    int agreeing = 0;
    for (int ray = 0; std::getline(answers, row); ++ray) {
        const std::string number = std::to_string(ray) + ",";
        REQUIRE(hit.starts_with(number) == (row[0] == '1'));
        if (row[0] == '1')
            REQUIRE(fields_of(hit)[2] == fields_of(row)[2]);
        while (hit.starts_with(number) && std::getline(listed, hit))
            ++agreeing;
    }
    CHECK(agreeing > 10000);
}

TEST_CASE("rays come from standard input, hits leave by standard output", "[intersect_cli]")
{
    const TempFolder folder;
    write_text(folder / "hand.scene", hand_scene);
    write_text(folder / "rays.csv", hand_rays());
    write_text(folder / "bad.csv", "0\n");
    const auto at = [&](std::string_view name) { return shell_quoted((folder / name).string()); };
    const std::string words = "intersect " + at("hand.scene") + " - 2>" + at("err");
    CHECK(run_in_shell(words + " <" + at("rays.csv") + " >" + at("out")).exit_code == 0);
    CHECK(read_text(folder / "out") == hand_rows());
    CHECK(run_in_shell(words + " <" + at("bad.csv") + " >" + at("out")).exit_code == 1);
    CHECK_THAT(read_text(folder / "err"), ContainsSubstring("standard input:1:1: 1 column"));
    CHECK(run_in_shell(words + " <" + at("rays.csv") + " >/dev/full").exit_code == 1);
    CHECK(read_text(folder / "err") == "standard output: can't write: No space left on device\n");
}

TEST_CASE("intersect gives the same answers by either traversal", "[intersect_cli]")
{
    for (const char* const traversal : {"auto", "list", "tree"}) {
        const ProgramResult result = intersect(hand_rays(), {"--traversal", traversal});
        CHECK(result.exit_code == 0);
        CHECK(result.out == hand_rows());
    }
    CHECK(intersect("", {"--traversal", "none"}).exit_code == 2);
    // intersect traces no secondary rays.
    CHECK(intersect("", {"--self-hits", "note"}).exit_code == 2);
    CHECK(intersect("", {"--kernel", "scalar", "--traversal", "tree"}).exit_code == 2);
}

TEST_CASE("the help of intersect names the columns and every option", "[intersect_cli]")
{
    const ProgramResult result = run_packtrace({"intersect", "--help"});
    CHECK(result.exit_code == 0);
    for (const std::string word :
         {"ox,oy,oz,dx,dy,dz[,t_min,t_max]", "hit,t,object,nx,ny,nz", "--all", "--any", "--bounds",
          "--kernel packet|scalar", "--precision single|double", "--isa", "--width", "--threads",
          "--output", "--accuracy", "--traversal auto|list|tree"})
        CHECK_THAT(result.out, ContainsSubstring(word));
}

TEST_CASE("intersect prints the example of the reference page", "[intersect_cli]")
{
    const std::string page = read_text(PACKTRACE_SOURCE_DIR "/docs/intersect.md");
    const auto block = [&](const std::string& kind) {
        const std::string begin = "```" + kind + "\n";
        const std::size_t first = page.find(begin);
        REQUIRE(first != std::string::npos);
        const std::size_t start = first + begin.size();
        return page.substr(start, page.find("```", start) - start);
    };
    const TempFolder folder;
    write_text(folder / "a.scene", block("scene"));
    write_text(folder / "rays.csv", block("rays"));
    CHECK(
        run_packtrace({"intersect", (folder / "a.scene").string(), (folder / "rays.csv").string()})
            .out == block("hits"));
    CHECK(run_packtrace({"intersect", (folder / "a.scene").string(), (folder / "rays.csv").string(),
                         "--bounds"})
              .out == block("bounds"));
}

TEST_CASE("a million rays take no more memory than fifty thousand", "[intersect_cli][slow]")
{
    const TempFolder folder;
    write_text(folder / "hand.scene", hand_scene);
    const std::string some = random_text(50000);
    write_text(folder / "some.csv", some);
    std::string many;
    for (int i = 0; i < 20; ++i)
        many += some;
    write_text(folder / "many.csv", many);
    const auto at = [&](std::string_view name) { return shell_quoted((folder / name).string()); };
    const auto peak = [&](std::string_view rays, const std::string& more) {
        const ShellResult result = run_in_shell("intersect " + at("hand.scene") + " " + at(rays) +
                                                " -o " + at("hits.csv") + " " + more);
        REQUIRE(result.exit_code == 0);
        return result.peak_memory;
    };
    for (const std::string more : {"", "--all", "--any"}) {
        const long few = peak("some.csv", more);
        const long full = peak("many.csv", more);
        CAPTURE(more, few, full, many.size());
        CHECK(full < few + 8 * 1024);
    }
}

}  // namespace packtrace::test
