#include "catch.hpp"
#include "intersect_program.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

// Error messages of `packtrace intersect`.
namespace packtrace::test {
namespace {

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("a wrong line is named by line and column, with a remedy", "[intersect_errors]")
{
    const std::string wide = "ox,oy,oz,dx,dy,dz,t_min,t_max\n";
    const std::string one = "is no number; write one such as 0.5";
    const std::string finite = "is not finite; write a finite number";
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"0,0,0,0,0,1\n0,0,x,0,0,1\n", "2:5: oz 'x' " + one},
        {"# c\n\n0,0,0,0,0,1\n0,0,0,0,1e,1\n", "4:9: dy '1e' " + one},
        {"0,0,0,0,0,1\n0,0,0,0,,1\n", "2:9: dy '' " + one},
        {"0,0,0,0,0,1\n0,0,0,0,0, 1 2\n", "2:12: dz '1 2' " + one},
        {"0,0,0,0,0,1\n0,0,0,+-1,0,1\n", "2:7: dx '+-1' " + one},
        {"0,0,0,0,0,1\n0,0,0,0x1,0,1\n", "2:7: dx '0x1' " + one},
        {"0,0,0,0,0,1\n\"0\",0,0,0,0,1\n", "2:1: ox '\"0\"' " + one},
        {"0,0,0,0,0,1\n0,0,0,0,0,\xFF\x01\n", "2:11: dz '\\xff\\x01' " + one},
        {"x,y,z,dx,dy,dz\n", "1:1: ox 'x' " + one +
                                 ", or as a header line ox,oy,oz,dx,dy,dz or "
                                 "ox,oy,oz,dx,dy,dz,t_min,t_max"},
        {"0,0,0,0,0,1\nox,oy,oz,dx,dy,dz\n", "2:1: ox 'ox' " + one},
        {"nan,0,0,0,0,1\n", "1:1: ox 'nan' " + finite},
        {"0,0,-inf,0,0,1\n", "1:5: oz '-inf' " + finite},
        {"0,0,0,0,inf,1\n", "1:9: dy 'inf' " + finite},
        {wide + "0,0,0,0,0,1,inf,inf\n", "2:13: t_min 'inf' " + finite},
        {wide + "0,0,0,0,0,1,0,nan\n",
         "2:15: t_max 'nan' is not a number; write a number, or inf for a ray without an end"},
        {"1e151,0,0,0,0,1\n",
         "1:1: ox '1e151' is further than squares of doubles reach; stay within 1e150"},
        {wide + "0,0,0,0,0,1,-0.5,inf\n",
         "2:13: t_min '-0.5' is below 0; a ray starts at t_min >= 0"},
        {"0,0,0,0,0,1e999\n", "1:11: dz '1e999' is out of the range of double precision"},
        {"0,0,0,0,0,1\n1,2,3,0,-0,0.0\n",
         "2:7: the direction is zero and leads nowhere; make one of dx, dy, dz differ from 0"},
        {"0,0,0,0,0,1\n0,0,0,0,0\n", "2:10: 5 columns where line 1 has 6; write 6 on every line"},
        {"0,0,0,0,0,1\n0,0,0,0,0,1,\n",
         "2:13: 7 columns where line 1 has 6; write 6 on every line"},
        {wide + "0,0,0,0,0,1\n", "2:12: 6 columns where line 1 has 8; write 8 on every line"},
        {"\n0,0,0,0,0,1,2\n",
         "2:1: 7 columns can't be a ray; write 6, ox,oy,oz,dx,dy,dz, or 8 with t_min,t_max after "
         "them"},
        {"hello\n",
         "1:1: 1 column can't be a ray; write 6, ox,oy,oz,dx,dy,dz, or 8 with t_min,t_max after "
         "them"},
        {"0,0,0,0,0,1\n" + std::string(70000, '0'),
         "2:1: a line of 65536 bytes or more can't be a ray; write one ray a line"},
    };
    for (const auto& [rays, message] : wrong) {
        CAPTURE(rays.substr(0, 200));
        const ProgramResult result = intersect(rays);
        CHECK(result.exit_code == 1);
        CHECK(result.err == "rays.csv:" + message + "\n");
    }
}

TEST_CASE("numbers that single precision can't hold are refused or become zero",
          "[intersect_errors]")
{
    const Words single{"--precision", "single"};
    CHECK(intersect("1e39,0,0,0,0,1\n").exit_code == 0);
    CHECK(intersect("1e39,0,0,0,0,1\n", single).err ==
          "rays.csv:1:1: ox '1e39' is out of the range of single precision\n");
    const std::string row = "hit,t,object,nx,ny,nz\n1,1,ball,0,0,1\n";
    CHECK(intersect("0,0,5,0,1e-400,1\n").out == row);
    CHECK(intersect("0,0,5,1e-60,1e-400,1\n", single).out == row);
    CHECK_THAT(intersect("0,0,5,0,0,1e-60\n", single).err,
               ContainsSubstring("rays.csv:1:7: the direction is zero"));
}

TEST_CASE("directions are accepted if their precision can square their length",
          "[intersect_errors]")
{
    const Words single{"--precision", "single"};
    const auto along_z = [](const std::string& length) { return "0,0,0,0,0," + length + "\n"; };
    for (const std::string kernel : {"packet", "scalar"}) {
        const Words kernel_words{"--kernel", kernel};
        for (const auto& [length, t] :
             std::vector<std::pair<std::string, double>>{{"1e-100", 4e100}, {"1e100", 4e-100}}) {
            const std::string out = intersect(along_z(length), kernel_words).out;
            CHECK(std::abs(std::stod(out.substr(out.find("\n1,") + 3)) / t - 1) < 1e-14);
        }
    }
    for (const auto& [length, t] :
         std::vector<std::pair<std::string, double>>{{"1.01e-12", 4 / 1.01e-12}, {"1e12", 4e-12}}) {
        const std::string out = intersect(along_z(length), single).out;
        CHECK(std::abs(std::stod(out.substr(out.find("\n1,") + 3)) / t - 1) < 1e-6);
    }
    CHECK(intersect(along_z("9e-101")).err ==
          "rays.csv:1:7: the direction is too short for double precision; scale it so that its "
          "largest component lies between 1e-100 and 1e100\n");
    CHECK_THAT(intersect(along_z("-1.1e100")).err, ContainsSubstring("too long for double"));
    CHECK(intersect(along_z("1.1e12"), single).err ==
          "rays.csv:1:7: the direction is too long for single precision; scale it so that its "
          "largest component lies between 1e-12 and 1e12\n");
    CHECK_THAT(intersect(along_z("9e-13"), single).err, ContainsSubstring("too short for single"));
}

TEST_CASE("of several wrong lines the first is named, however many threads", "[intersect_errors]")
{
    std::string rays;
    for (int i = 1; i <= 60000; ++i)
        rays += i >= 40000 && i % 1000 == 0 ? "0,0,0,0,0,bad\n" : "0,0,0,0,0,1\n";
    rays += std::string(70000, '1');
    for (const std::string threads : {"1", "2", "8"})
        CHECK_THAT(intersect(rays, {"--threads", threads}).err,
                   ContainsSubstring("rays.csv:40000:11: "));
}

TEST_CASE("bytes that are not text are refused", "[intersect_errors]")
{
    std::mt19937 random(11);
    for (const int size : {1, 10, 1000, 200000}) {
        std::string bytes;
        for (int i = 0; i < size; ++i)
            bytes += static_cast<char>(random() & 255u);
        bytes[0] = '\0';
        const ProgramResult result = intersect(bytes);
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    }
}

TEST_CASE("a file of hits appears whole or not at all", "[intersect_errors]")
{
    const TempFolder folder;
    const std::string out = (folder / "hits.csv").string();
    CHECK(intersect("0,0,0,0,0,1\n0\n", {"-o", out}).exit_code == 1);
    CHECK(folder.names().empty());

    const std::string row = "hit,t,object,nx,ny,nz\n1,4,ball,0,0,-1\n";
    const ProgramResult result = intersect("0,0,0,0,0,1\n", {"-o", out});
    CHECK(result.exit_code == 0);
    CHECK(result.out.empty());
    CHECK(read_text(out) == row);
    CHECK(folder.names() == Words{"hits.csv"});

    CHECK(intersect("0\n", {"-o", out}).exit_code == 1);
    CHECK(read_text(out) == row);
}

TEST_CASE("files that can't be used are named", "[intersect_errors]")
{
    const TempFolder folder;
    write_text(folder / "hand.scene", hand_scene);
    const std::string scene = (folder / "hand.scene").string();
    const std::string missing = (folder / "none.csv").string();
    CHECK(run_packtrace({"intersect", scene, missing}).err ==
          missing + ": can't read: No such file or directory; check its name\n");
    CHECK(run_packtrace({"intersect", scene, (folder / "").string()}).exit_code == 1);
    CHECK(run_packtrace({"intersect", missing, "-"}).exit_code == 1);
    CHECK(intersect("", {"-o", (folder / "no/hits.csv").string()}).exit_code == 1);
}

TEST_CASE("wrong use of intersect exits 2 with one line", "[intersect_errors]")
{
    const std::vector<Words> wrong{
        {"--all", "--any"},
        {"--precision", "extended"},
        {"--kernel", "gpu"},
        {"--isa", "none"},
        {"--width", "5"},
        {"--threads", "0"},
        {"--kernel", "scalar", "--isa", "avx2"},
        {"more"},
    };
    for (const Words& words : wrong) {
        CAPTURE(words);
        const ProgramResult result = intersect("0,0,0,0,0,1\n", words);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    }
    CHECK(run_packtrace({"intersect"}).exit_code == 2);
}

}  // namespace packtrace::test
