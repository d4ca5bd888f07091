#include "catch.hpp"
#include "run_program.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/image_io.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace {
namespace {

using test::ContainsSubstring;
using test::ProgramResult;
using test::run_packtrace;
using test::TempFolder;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A 3 by 2 picture with 0.5 in every channel.
template <class Real>
Image<Real> grey()
{
    Image<Real> image(3, 2);
    for (Real& value : image.rgb)
        value = Real(0.5);
    return image;
}

bool near(double a, double b)
{
    return std::abs(a - b) <= 1e-12 * std::abs(b);
}

/// a.pfm, and b.pfm that differs from it by 0.25 in one of six pixels.
void write_pair(const TempFolder& folder)
{
    Image<float> image = grey<float>();
    write_image(folder / "a.pfm", image);
    image.pixel(2, 1)[0] = 0.75f;
    write_image(folder / "b.pfm", image);
}

}  // namespace

TEST_CASE("equal pictures have no error and an infinite PSNR", "[compare]")
{
    const Comparison result = compare(grey<float>(), grey<float>());
    CHECK(result.max_abs == 0.0);
    CHECK(result.rmse == 0.0);
    CHECK(result.psnr == inf);
    CHECK(result.pixels == 6);
    CHECK(result.pixels_off == 0);
    CHECK(result.worst.empty());
}

TEMPLATE_TEST_CASE("errors are measured per channel and per pixel", "[compare]", float, double,
                   long double)
{
    const Image<TestType> a = grey<TestType>();
    Image<TestType> b = a;
    b.pixel(2, 0)[1] = TestType(0.75);
    b.pixel(0, 1)[0] = TestType(0.0);
    b.pixel(0, 1)[2] = TestType(1.0);
    b.pixel(1, 1)[2] = TestType(0.5) + TestType(1.0 / 512);
    const Comparison result = compare(a, b);
    CHECK(result.max_abs == 0.5);
    const double sum = 0.0625 + 0.25 + 0.25 + 1.0 / 512 / 512;
    CHECK(near(result.rmse, std::sqrt(sum / 18)));
    CHECK(near(result.psnr, -10 * std::log10(sum / 18)));
    CHECK(result.pixels_off == 2);
    REQUIRE(result.worst.size() == 3);
    CHECK((result.worst[0].x == 0 && result.worst[0].y == 1 && result.worst[0].error == 0.5));
    CHECK((result.worst[1].x == 2 && result.worst[1].y == 0 && result.worst[1].error == 0.25));
    CHECK((result.worst[2].x == 1 && result.worst[2].y == 1));
    CHECK(result.worst[2].error == 1.0 / 512);
}

TEST_CASE("long double pictures are compared beyond double", "[compare]")
{
    const Image<long double> a = grey<long double>();
    Image<long double> b = a;
    b.rgb[4] += 0x1p-60L;
    const bool wide = std::numeric_limits<long double>::digits > 61;
    CHECK(compare(a, b).max_abs == (wide ? 0x1p-60 : 0.0));
}

TEST_CASE("an error equal to the threshold does not exceed it", "[compare]")
{
    const Image<double> a = grey<double>();
    Image<double> b = a;
    b.pixel(1, 0)[0] = 0.75;
    CHECK(compare(a, b, {.threshold = 0.25}).pixels_off == 0);
    CHECK(compare(a, b, {.threshold = 0.2499}).pixels_off == 1);
}

TEST_CASE("the worst pixels come in reading order where errors tie", "[compare]")
{
    const Image<double> a = grey<double>();
    Image<double> b = a;
    for (double& value : b.rgb)
        value = 0.25;
    b.pixel(1, 1)[0] = 0.0;
    const Comparison result = compare(a, b, {.worst = 3});
    REQUIRE(result.worst.size() == 3);
    CHECK((result.worst[0].x == 1 && result.worst[0].y == 1));
    CHECK((result.worst[1].x == 0 && result.worst[1].y == 0));
    CHECK((result.worst[2].x == 1 && result.worst[2].y == 0));
    CHECK(compare(a, b, {.worst = 0}).worst.empty());
    CHECK(compare(a, b, {.worst = 100}).worst.size() == 6);
    CHECK_THROWS_WITH(compare(a, b, {.worst = -1}), ContainsSubstring("worst: -1"));
}

TEST_CASE("NaN is infinitely far from everything, infinity only from others", "[compare]")
{
    const auto error = [](double va, double vb) {
        Image<double> a = grey<double>();
        Image<double> b = a;
        a.pixel(1, 1)[2] = va;
        b.pixel(1, 1)[2] = vb;
        const Comparison result = compare(a, b);
        CHECK(result.pixels_off == (result.max_abs > 0.0 ? 1 : 0));
        return result.max_abs;
    };
    CHECK(error(nan, 0.5) == inf);
    CHECK(error(0.5, nan) == inf);
    CHECK(error(nan, nan) == inf);
    CHECK(error(inf, 0.5) == inf);
    CHECK(error(inf, -inf) == inf);
    CHECK(error(inf, inf) == 0.0);
}

TEST_CASE("pictures of different sizes are refused with both sizes", "[compare]")
{
    const Image<float> a(3, 2);
    const Image<float> b(2, 3);
    CHECK_THROWS_WITH(compare(a, b), ContainsSubstring("3 x 2 and 2 x 3"));
    CHECK_THROWS_AS(heatmap(a, b), std::invalid_argument);
}

TEST_CASE("the heat map runs from black over blue, green, yellow and red to white", "[compare]")
{
    Image<double> a(8, 1);
    const Image<double> b(8, 1);
    // Decades below the largest error, which is at 0. The colour stops are 1.2 decades apart.
    const std::vector<double> decades{0, 1.2, 2.4, 3.6, 4.8, 6, 7};
    for (int x = 0; x < 7; ++x)
        a.pixel(x, 0)[1] = std::pow(10.0, -decades[static_cast<std::size_t>(x)]);
    const std::vector<std::vector<float>> expected{{1, 1, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                   {0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    const Image<float> map = heatmap(a, b);
    for (int x = 0; x < 8; ++x)
        for (int c = 0; c < 3; ++c) {
            INFO("pixel " << x << " channel " << c);
            CHECK(std::abs(map.pixel(x, 0)[c] -
                           expected[static_cast<std::size_t>(x)][static_cast<std::size_t>(c)]) <
                  1e-5f);
        }
}

TEST_CASE("an infinite error is white and does not set the heat map's scale", "[compare]")
{
    Image<double> a(3, 1);
    const Image<double> b(3, 1);
    a.pixel(0, 0)[0] = nan;
    a.pixel(1, 0)[0] = 1e-3;
    const Image<float> map = heatmap(a, b);
    CHECK(map.rgb == Image<float>::Pixels{1, 1, 1, 1, 1, 1, 0, 0, 0});
}

TEST_CASE("packtrace compare prints the distance of two files", "[compare]")
{
    const TempFolder folder;
    write_pair(folder);
    const ProgramResult result = run_packtrace(
        {"compare", folder / "a.pfm", folder / "b.pfm", "--heatmap", folder / "map.png"});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    CHECK_THAT(result.out, ContainsSubstring("max abs error  0.25\n"));
    CHECK_THAT(result.out, ContainsSubstring("pixels off     1 of 6 (16.6667 %) by more than"));
    CHECK_THAT(result.out, ContainsSubstring("worst          0.25 at 2,1\n"));
    const Image<float> map = read_image(folder / "map.png");
    CHECK(map.pixel(2, 1)[0] == 1.0f);
    CHECK(map.pixel(1, 1)[0] == 0.0f);
}

TEST_CASE("packtrace compare --json prints what it measured", "[compare]")
{
    const TempFolder folder;
    write_pair(folder);
    const ProgramResult result =
        run_packtrace({"compare", folder / "a.pfm", folder / "b.pfm", "--json"});
    const auto json = nlohmann::json::parse(result.out);
    CHECK(json["max_abs"] == 0.25);
    CHECK(json["width"] == 3);
    CHECK(json["pixels_off"] == 1);
    CHECK(json["worst"][0] == nlohmann::json({{"x", 2}, {"y", 1}, {"error", 0.25}}));
    CHECK(json["equal"] == false);
    CHECK(json["psnr"].get<double>() > 18.5);

    const ProgramResult same =
        run_packtrace({"compare", folder / "a.pfm", folder / "a.pfm", "--json"});
    const auto same_json = nlohmann::json::parse(same.out);
    CHECK(same_json["equal"] == true);
    CHECK(same_json["psnr"].is_null());
    CHECK(same_json["worst"].empty());
}

TEST_CASE("packtrace compare takes its threshold as a number or a fraction", "[compare]")
{
    const TempFolder folder;
    write_pair(folder);
    const auto run = [&](const std::string& threshold) {
        const ProgramResult result = run_packtrace(
            {"compare", folder / "a.pfm", folder / "b.pfm", "--threshold", threshold, "--json"});
        return nlohmann::json::parse(result.out);
    };
    CHECK(run("1/255")["threshold"] == 1.0 / 255.0);
    CHECK(run("1/4")["pixels_off"] == 0);
    CHECK(run("0.5/2.5")["pixels_off"] == 1);
    CHECK(run("0.25")["pixels_off"] == 0);
    CHECK(run("0/1")["threshold"] == 0.0);
}

TEST_CASE("packtrace compare works across formats", "[compare]")
{
    const TempFolder folder;
    write_image(folder / "a.png", grey<float>());
    write_image(folder / "a.hdr", grey<float>());
    const ProgramResult result =
        run_packtrace({"compare", folder / "a.png", folder / "a.hdr", "--max-error", "0.002"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out, ContainsSubstring("max abs error  0.00196"));
}

TEST_CASE("packtrace compare exits 1 beyond --max-error, with its result", "[compare]")
{
    const TempFolder folder;
    Image<float> image = grey<float>();
    write_image(folder / "a.pfm", image);
    image.rgb[0] = 0.75f;
    write_image(folder / "b.pfm", image);
    const auto run = [&](const std::string& limit) {
        return run_packtrace({"compare", folder / "a.pfm", folder / "b.pfm", "--max-error", limit});
    };
    CHECK(run("0.25").exit_code == 0);
    const ProgramResult beyond = run("0.2499");
    CHECK(beyond.exit_code == 1);
    CHECK(beyond.err == "packtrace: the largest error is 0.25, above --max-error 0.2499\n");
    CHECK_THAT(beyond.out, ContainsSubstring("max abs error  0.25\n"));
    CHECK(run("1/4").exit_code == 0);
    CHECK(run("60/255").err ==
          "packtrace: the largest error is 0.25, above --max-error 0.235294\n");
    CHECK(run("0").exit_code == 1);
}

TEST_CASE("packtrace compare names both files and sizes that differ", "[compare]")
{
    const TempFolder folder;
    write_image(folder / "a.png", Image<float>(3, 2));
    write_image(folder / "b.png", Image<float>(4, 5));
    const ProgramResult result = run_packtrace(
        {"compare", folder / "a.png", folder / "b.png", "--heatmap", folder / "map.png"});
    CHECK(result.exit_code == 1);
    CHECK(result.out.empty());
    CHECK(result.err == "can't compare pictures of different size: " + (folder / "a.png").string() +
                            " is 3 x 2, " + (folder / "b.png").string() + " is 4 x 5\n");
    CHECK(folder.names() == std::vector<std::string>{"a.png", "b.png"});
}

TEST_CASE("packtrace compare refuses wrong use with exit 2 and one line", "[compare]")
{
    const TempFolder folder;
    write_image(folder / "a.png", Image<float>(3, 2));
    const std::string a = folder / "a.png";
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"compare"}, "A is required"},
        {{"compare", a}, "B is required"},
        {{"compare", a, a, "--threshold", "nan"}, "'nan' is not a number from 0 up"},
        {{"compare", a, a, "--threshold", "-1"}, "'-1' is not a number from 0 up"},
        {{"compare", a, a, "--threshold", "1/0"}, "'1/0' is not a number from 0 up, or a fraction"},
        {{"compare", a, a, "--threshold", "1/inf"}, "'1/inf' is not a number from 0 up"},
        {{"compare", a, a, "--threshold", "-1/-255"}, "'-1/-255' is not a number from 0 up"},
        {{"compare", a, a, "--threshold", "1/"}, "'1/' is not a number from 0 up"},
        {{"compare", a, a, "--threshold", "/255"}, "'/255' is not a number from 0 up"},
        {{"compare", a, a, "--threshold", "1/2/3"}, "'1/2/3' is not a number from 0 up"},
        {{"compare", a, a, "--max-error", "inf"}, "'inf' is not a number from 0 up"},
        {{"compare", a, a, "--max-error", "-1"}, "'-1' is not a number from 0 up"},
        {{"compare", a, a, "--max-error", "1/0"}, "'1/0' is not a number from 0 up, or a fraction"},
        {{"compare", a, a, "--worst", "-2"}, "'-2' is not a whole number from 0 to 2147483647"},
        {{"compare", a, a, "--worst", "2.5"}, "'2.5' is not a whole number"},
        {{"compare", a, a, a}, "unexpected argument"},
        {{"compare", a, a, "--nonsense"}, "--nonsense"},
    };
    for (const auto& [arguments, reason] : wrong) {
        const ProgramResult result = run_packtrace(arguments);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK_THAT(result.err, ContainsSubstring(reason));
        CHECK(result.err.find('\n') == result.err.size() - 1);
    }
}

TEST_CASE("packtrace compare names the picture that it can't read", "[compare]")
{
    const TempFolder folder;
    write_image(folder / "a.png", Image<float>(3, 2));
    const ProgramResult result = run_packtrace({"compare", folder / "a.png", folder / "none.pfm"});
    CHECK(result.exit_code == 1);
    CHECK(result.err == (folder / "none.pfm").string() +
                            ": can't read: No such file or directory; check its name\n");
}

}  // namespace packtrace
