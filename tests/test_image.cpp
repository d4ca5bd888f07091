#include "catch.hpp"
#include "core/atomic_file.hpp"
#include "refusal.hpp"
#include "temp_folder.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/image_io.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <vector>

namespace packtrace {
namespace {

using namespace std::string_literals;
using test::ContainsSubstring;
using test::read_text;
using test::refusal;
using test::TempFolder;
using test::write_text;

using Pixels = Image<float>::Pixels;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Image<float> image_of(int width, int height, const std::vector<float>& values)
{
    Image<float> image(width, height);
    image.rgb.assign(values.begin(), values.end());
    return image;
}

// A picture with a different value in every channel of every pixel.
Image<float> gradient(int width, int height)
{
    Image<float> image(width, height);
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        image.rgb[i] = static_cast<float>(i * 7 % 256) / 255.0f;
    return image;
}

std::string error_of_reading(const std::filesystem::path& file)
{
    return refusal<ImageError>([&] { return read_image(file); });
}

std::string error_of_writing(const std::filesystem::path& file)
{
    return refusal<ImageError>([&] { write_image(file, gradient(3, 2)); });
}

// Limits the size of written files for the lifetime of the object; longer writes fail.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int);
};

std::vector<std::uint32_t> bits(const Image<float>& image)
{
    std::vector<std::uint32_t> words;
    for (const float value : image.rgb)
        words.push_back(std::bit_cast<std::uint32_t>(value));
    return words;
}

}  // namespace

TEST_CASE("a new picture is black, unless it is left uninitialized", "[image]")
{
    for (const int edge : {1, 3, 700}) {
        {
            Image<float> dirty(edge, edge);
            dirty.rgb.assign(dirty.rgb.size(), 7.0f);
        }
        const Image<float> image(edge, edge);
        REQUIRE(image.rgb.size() == static_cast<std::size_t>(edge * edge * 3));
        CHECK(std::all_of(image.rgb.begin(), image.rgb.end(), [](float v) { return v == 0.0f; }));
        CHECK(Image<float>::unset(edge, edge).rgb.size() == image.rgb.size());
    }
}

TEST_CASE("every 8-bit value survives a PNG", "[image]")
{
    const TempFolder folder;
    Image<float> image(256, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 256; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] = static_cast<float>((x + 50 * c + 90 * y) % 256) / 255.0f;
    write_image(folder / "a.png", image);
    const Image<float> back = read_image(folder / "a.png");
    CHECK(back.width == 256);
    CHECK(back.height == 3);
    CHECK(back.rgb == image.rgb);
}

TEST_CASE("a PNG clamps, rounds to the nearest and has no NaN", "[image]")
{
    const TempFolder folder;
    write_image(folder / "a.png", image_of(3, 1,
                                           {nan, inf, -inf, -1.0f, 2.0f, 0.5f, 0.4999f / 255,
                                            0.5001f / 255, 254.4f / 255}));
    const Pixels expected{0, 1, 0, 0, 1, 128.0f / 255, 0, 1.0f / 255, 254.0f / 255};
    CHECK(read_image(folder / "a.png").rgb == expected);
}

TEST_CASE("gamma raises a PNG's values to its inverse", "[image]")
{
    const TempFolder folder;
    write_image(folder / "a.png", image_of(1, 1, {0.25f, nan, -0.25f}), {.gamma = 2.0});
    CHECK(read_image(folder / "a.png").rgb == Pixels{128.0f / 255, 0, 0});
    for (const double bad : {0.0, -1.0, std::nan(""), static_cast<double>(inf)})
        for (const char* name : {"b.png", "b.pfm", "b.hdr"})
            CHECK_THROWS_AS(write_image(folder / name, gradient(1, 1), {.gamma = bad}),
                            std::invalid_argument);
    for (const char* name : {"b.pfm", "b.hdr"})
        CHECK(refusal<std::invalid_argument>(
                  [&] { write_image(folder / name, gradient(1, 1), {.gamma = 2.2}); }) ==
              "gamma: only PNG has one; .pfm and .hdr hold linear values; leave it out or "
              "write .png");
    CHECK(folder.names() == std::vector<std::string>{"a.png"});
}

TEST_CASE("a PNG is 8-bit RGB", "[image]")
{
    const TempFolder folder;
    write_image(folder / "a.png", gradient(258, 3));
    const std::string head = read_text(folder / "a.png").substr(0, 29);
    CHECK(head == "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\1\2\0\0\0\3\x08\2\0\0\0"s);
}

TEST_CASE("a noisy and a flat picture survive a PNG", "[image]")
{
    const TempFolder folder;
    Image<float> noise(700, 500);
    std::uint32_t state = 1;
    for (float& value : noise.rgb) {
        state = state * 1664525u + 1013904223u;
        value = static_cast<float>(state >> 24) / 255.0f;
    }
    write_image(folder / "noise.png", noise);
    CHECK(read_image(folder / "noise.png").rgb == noise.rgb);
    const Image<float> flat(2000, 900);
    write_image(folder / "flat.png", flat);
    CHECK(read_image(folder / "flat.png").rgb == flat.rgb);
}

TEST_CASE("a PFM has rows from the bottom in little-endian floats", "[image]")
{
    const TempFolder folder;
    write_image(folder / "a.pfm", image_of(1, 2, {1.0f, 2.0f, -0.5f, 0.0f, inf, 1.5f}));
    CHECK(read_text(folder / "a.pfm") ==
          "PF\n1 2\n-1.0\n"
          "\0\0\0\0\0\0\x80\x7f\0\0\xc0\x3f"
          "\0\0\x80\x3f\0\0\0\x40\0\0\0\xbf"s);
}

TEST_CASE("a PFM keeps every bit", "[image]")
{
    const TempFolder folder;
    const Image<float> image = image_of(2, 2,
                                        {nan, inf, -inf, -0.0f, 1e-45f, 3.4e38f, 0.1f, -7.0f, 1.0f,
                                         2.0f, 3.0f, std::nextafter(1.0f, 2.0f)});
    write_image(folder / "a.PFM", image);
    CHECK(bits(read_image(folder / "a.PFM")) == bits(image));
}

TEST_CASE("a PFM is read in either byte order, in grey, and scaled", "[image]")
{
    const TempFolder folder;
    write_text(folder / "big.pfm", "PF\n1 1\n1.0\n\x3f\x80\0\0\x40\0\0\0\xbf\0\0\0"s);
    CHECK(read_image(folder / "big.pfm").rgb == Pixels{1.0f, 2.0f, -0.5f});
    write_text(folder / "grey.pfm", "Pf 2 1 -2\n\0\0\x80\x3f\0\0\0\xbf"s);
    CHECK(read_image(folder / "grey.pfm").rgb == Pixels{2, 2, 2, -1, -1, -1});
}

TEST_CASE("a wrong PFM is refused with the reason", "[image]")
{
    const TempFolder folder;
    const std::string pixel(12, '\0');
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"", "not a PFM file"},
        {"P6\n1 1\n255\n" + pixel, "not a PFM file"},
        {"PF\n0 1\n-1\n", "width and height"},
        {"PF\n1 -1\n-1\n" + pixel, "width and height"},
        {"PF\n1 x\n-1\n" + pixel, "width and height"},
        {"PF\n99999999999 1\n-1\n" + pixel, "width and height"},
        {"PF\n1 1\n0\n" + pixel, "the scale"},
        {"PF\n1 1\ninf\n" + pixel, "the scale"},
        {"PF\n1 1\n-1", "does not end"},
        {"PF\n1 1\n-1\n" + pixel.substr(1), "has 11 bytes where a picture of 1 x 1 needs 3 floats"},
        {"PF\n1 1\n-1\n" + pixel + "x", "has 13 bytes where"},
        {"PF\n2147483647 2147483647\n-1\n" + pixel, "needs 13835058042397261827 floats"},
    };
    for (const auto& [text, reason] : wrong) {
        write_text(folder / "a.pfm", text);
        const std::string message = error_of_reading(folder / "a.pfm");
        CHECK_THAT(message, ContainsSubstring((folder / "a.pfm").string() + ": "));
        CHECK_THAT(message, ContainsSubstring(reason));
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("Radiance HDR keeps eight bits of the largest channel", "[image]")
{
    // stb packs rows of 8 to 32767 pixels and leaves shorter ones plain.
    for (const int width : {1, 7, 8, 300}) {
        const TempFolder folder;
        Image<float> image(width, 5);
        for (std::size_t i = 0; i < image.rgb.size(); ++i)
            image.rgb[i] = std::exp(0.037f * static_cast<float>(i % 700) - 9.0f);
        write_image(folder / "a.hdr", image);
        const Image<float> back = read_image(folder / "a.hdr");
        REQUIRE(back.rgb.size() == image.rgb.size());
        float largest_error = 0.0f;
        for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
            const float scale = std::max({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
            for (std::size_t c = i; c < i + 3; ++c)
                largest_error =
                    std::max(largest_error, std::abs(back.rgb[c] - image.rgb[c]) / scale);
        }
        CHECK(largest_error < 1.0f / 128);
        CHECK(largest_error > 0.0f);
    }
}

TEST_CASE("Radiance HDR has no negative, infinite or NaN values", "[image]")
{
    const TempFolder folder;
    write_image(folder / "a.hdr", image_of(3, 1, {-1.0f, nan, 0.5f, 3.4e38f, 0, 0, inf, 0, 1}));
    const Image<float> back = read_image(folder / "a.hdr");
    CHECK(back.rgb[0] == 0.0f);
    CHECK(back.rgb[1] == 0.0f);
    CHECK(back.rgb[2] == 0.5f);
    CHECK(back.rgb[3] > 1.6e38f);
    CHECK(back.rgb[6] > 1.6e38f);
    CHECK(std::isfinite(back.rgb[6]));
}

TEST_CASE("a Radiance picture is divided by the product of its exposures", "[image]")
{
    const TempFolder folder;
    const auto pixel_of = [&](const std::string& lines) {
        // 2^(exponent - 136) times 128, 64 and 0: 0.5, 0.25 and 0.
        write_text(folder / "a.hdr",
                   "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + lines + "\n-Y 1 +X 1\n\x80\x40\0\x80"s);
        return read_image(folder / "a.hdr").rgb;
    };
    CHECK(pixel_of("") == Pixels{0.5f, 0.25f, 0});
    CHECK(pixel_of("EXPOSURE=          1.0000000000000\n") == Pixels{0.5f, 0.25f, 0});
    CHECK(pixel_of("EXPOSURE=2\n") == Pixels{0.25f, 0.125f, 0});
    CHECK(pixel_of("EXPOSURE= +2.5e-1 \n") == Pixels{2, 1, 0});
    CHECK(pixel_of("EXPOSURE=4\npfilt -x 512\nEXPOSURE=0.5\nEXPOSURE=4\n") ==
          Pixels{0.0625f, 0.03125f, 0});
    // Each of these exposures is beyond single precision.
    CHECK(pixel_of("EXPOSURE=1e60\nEXPOSURE=1e-60\n") == Pixels{0.5f, 0.25f, 0});
    // The header copied by a program that combined pictures.
    CHECK(pixel_of("\tEXPOSURE=8\n") == Pixels{0.5f, 0.25f, 0});
}

TEST_CASE("files that contradict their extension are refused", "[image]")
{
    const TempFolder folder;
    write_image(folder / "a.hdr", gradient(9, 9));
    std::filesystem::rename(folder / "a.hdr", folder / "a.png");
    CHECK_THAT(error_of_reading(folder / "a.png"), ContainsSubstring("a.png: not a PNG file"));
    write_image(folder / "b.png", gradient(9, 9));
    std::filesystem::rename(folder / "b.png", folder / "b.hdr");
    CHECK_THAT(error_of_reading(folder / "b.hdr"),
               ContainsSubstring("b.hdr: not a Radiance HDR file"));
    write_text(folder / "empty.png", "");
    CHECK_THAT(error_of_reading(folder / "empty.png"), ContainsSubstring("not a PNG file"));
}

TEST_CASE("a picture truncated anywhere is refused", "[image]")
{
    const TempFolder folder;
    for (const std::string name : {"a.png", "a.hdr", "a.pfm"}) {
        write_image(folder / name, gradient(16, 4));
        const std::string whole = read_text(folder / name);
        // The last 12 bytes of a PNG hold no pixels, and the reader does not need them.
        for (std::size_t length = 0; length + 12 < whole.size(); ++length) {
            write_text(folder / name, whole.substr(0, length));
            INFO(name << " of " << length << " bytes");
            CHECK(error_of_reading(folder / name) != "accepted");
        }
    }
}

TEST_CASE("Radiance HDR is read with runs of the old coding", "[image]")
{
    const TempFolder folder;
    const std::string size = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ";
    const std::string pixel = "\x80\x40\x20\x81";
    write_text(folder / "a.hdr", size + "1 +X 12\n" + pixel + "\1\1\1\xb");
    const Image<float> row = read_image(folder / "a.hdr");
    REQUIRE(row.width == 12);
    for (int x = 0; x < row.width; ++x)
        CHECK(Pixels(row.pixel(x, 0), row.pixel(x, 0) + 3) == Pixels{1, 0.5f, 0.25f});

    // 2 + 1 * 256 + 1 * 65536 copies, then another pixel and one copy, in each of two rows.
    const std::string long_row = pixel + "\1\1\1\2\1\1\1\1\1\1\1\1" + "\x80\0\0\x80"s + "\1\1\1\1";
    write_text(folder / "b.hdr", size + "2 +X 65797\n" + long_row + long_row);
    const Image<float> rows = read_image(folder / "b.hdr");
    REQUIRE(rows.width == 65797);
    REQUIRE(rows.height == 2);
    for (int y = 0; y < rows.height; ++y)
        for (const auto& [x, red] :
             {std::pair{0, 1.0f}, {65794, 1.0f}, {65795, 0.5f}, {65796, 0.5f}})
            CHECK(rows.pixel(x, y)[0] == red);
}

TEST_CASE("a wrong Radiance file is refused with the reason", "[image]")
{
    const TempFolder folder;
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234", "32-bit_rle_xyze"},
        {head + "+Y 1 +X 1\n1234", "'+Y 1 +X 1' is not of the form -Y height +X width"},
        {head + "-Y 1 +X 0\n1234", "is not of the form"},
        {head + "-Y 1 +X 1\n123", "ends early"},
        {head + "-Y 99999999 +X 99999999\n1234", "ends early"},
        {head + "-Y 1 +X 8\n\2\2\0\x8\x89\1"s + std::string(40, '\1'), "does not fit its row"},
        {head + "-Y 1 +X 8\n\2\2\0\x8\0"s + std::string(40, '\1'), "does not fit its row"},
        {head + "-Y 1 +X 3\n1234\1\1\1\3", "does not fit its row"},
        {head + "-Y 1 +X 258\n1234\1\1\1\2\1\1\1\1", "does not fit its row"},
        {head + "-Y 1 +X 2\n\1\1\1\1" + "1234", "does not fit its row"},
        {head + "-Y 2 +X 2\n1234\1\1\1\1\1\1\1\2", "does not fit its row"},
        {head + "-Y 1 +X 999999999\n1234\1\1\1\xff\1\1\1\xff", "ends early"},
        {head + "-Y 1 +X 2\n1234\1\1\1\1.", "goes on after its last row"},
        {head + "-Y 1 +X 1\n12345678", "goes on after its last row"},
        {head + "-Y 1 +X 8\n\2\2\0\x8\x88\1\x88\1\x88\1\x88\1"s + "\n",
         "goes on after its last row"},
    };
    for (const auto& [text, reason] : wrong) {
        write_text(folder / "a.hdr", text);
        CHECK_THAT(error_of_reading(folder / "a.hdr"), ContainsSubstring(reason));
    }
}

TEST_CASE("a wrong exposure of a Radiance file is refused in one line", "[image]")
{
    const TempFolder folder;
    const auto refusal_of = [&](const std::string& lines) {
        write_text(folder / "a.hdr", "#?RADIANCE\n" + lines + "\n-Y 1 +X 1\n1234");
        const std::string message = error_of_reading(folder / "a.hdr");
        CHECK(message.starts_with((folder / "a.hdr").string() + ": "));
        return message.substr(message.find(": ") + 2);
    };
    for (const std::string bad :
         {"", " ", "0", "-1", "nan", "inf", "1e400", "1e-400", "0x10", "1,5", "1 2", "one"})
        CHECK(refusal_of("EXPOSURE=2\nEXPOSURE=" + bad + "\n") ==
              "HDR exposure '" + bad + "' is not a number above 0");
    for (const std::string each : {"1e30", "1e-30", "1e300", "1e-300"})
        CHECK(refusal_of("EXPOSURE=" + each + "\nEXPOSURE=" + each + "\n") ==
              "the product of all HDR exposures is too large or too small");
}

TEST_CASE("an unknown extension lists the known ones", "[image]")
{
    const TempFolder folder;
    CHECK_THAT(error_of_writing(folder / "a.jpg"),
               ContainsSubstring("a.jpg: unknown picture format '.jpg'; use .png, .pfm or .hdr"));
    CHECK_THAT(error_of_writing(folder / "picture"),
               ContainsSubstring("picture: no extension tells the picture format"));
    CHECK_THAT(error_of_reading(folder / "a.gif"), ContainsSubstring("use .png, .pfm or .hdr"));
    CHECK(folder.names().empty());
}

TEST_CASE("a file that can't be opened names itself and the reason", "[image]")
{
    const TempFolder folder;
    CHECK(error_of_reading(folder / "none.png") ==
          (folder / "none.png").string() +
              ": can't read: No such file or directory; check its name");
    CHECK(error_of_writing(folder / "no/a.png") ==
          (folder / "no/a.png").string() +
              ": can't write: No such file or directory; make its folder first");
    write_text(folder / "file", "");
    CHECK_THAT(error_of_writing(folder / "file/a.png"), ContainsSubstring(": Not a directory"));
    std::filesystem::create_directory(folder / "folder.png");
    CHECK_THAT(error_of_writing(folder / "folder.png"), ContainsSubstring(": Is a directory"));
    CHECK_THAT(error_of_reading(folder / "folder.png"), ContainsSubstring(": Is a directory"));
    CHECK(folder.names() == std::vector<std::string>{"file", "folder.png"});
}

TEST_CASE("a disk that fills up leaves the old file and nothing else", "[image]")
{
    const TempFolder folder;
    write_text(folder / "a.pfm", "old");
    // A limit on the size of files simulates the full disk. The small picture reaches it only when
    // the file is closed.
    for (const int size : {10, 64}) {
        const std::string message = refusal<ImageError>([&] {
            const FileSizeLimit limit(100);
            write_image(folder / "a.pfm", gradient(size, size));
        });
        CHECK(message == (folder / "a.pfm").string() + ": can't write: File too large");
        CHECK(folder.names() == std::vector<std::string>{"a.pfm"});
        CHECK(read_text(folder / "a.pfm") == "old");
    }
}

TEST_CASE("the check for writability leaves no file", "[image]")
{
    const TempFolder folder;
    check_image_writable(folder / "a.png");
    CHECK_THROWS_AS(check_image_writable(folder / "a.bmp"), ImageError);
    CHECK_THROWS_AS(check_image_writable(folder / "no/a.png"), ImageError);
    CHECK(folder.names().empty());
}

TEST_CASE("a picture without pixels is not written", "[image]")
{
    const TempFolder folder;
    CHECK_THROWS_AS(write_image(folder / "a.png", Image<float>()), ImageError);
    CHECK(folder.names().empty());
}

TEST_CASE("an atomic file appears only with its commit", "[image]")
{
    const TempFolder folder;
    write_text(folder / "a", "old");
    {
        AtomicFile file(folder / "a");
        file.write("new");
        CHECK(folder.names().size() == 2);
    }
    CHECK(folder.names() == std::vector<std::string>{"a"});
    CHECK(read_text(folder / "a") == "old");
    AtomicFile file(folder / "a");
    AtomicFile second(folder / "a");
    file.write("new");
    file.commit();
    CHECK(read_text(folder / "a") == "new");
}

TEST_CASE("values of higher precision are rounded once, to the file's precision", "[image]")
{
    // Just below halfway between two bytes: the nearest float is often above.
    Image<double> image(255, 1);
    for (int x = 0; x < 255; ++x)
        for (int channel = 0; channel < 3; ++channel)
            image.pixel(x, 0)[channel] = (x + 0.5) / 255.0 - 1e-12;
    const TempFolder folder;
    write_image(folder / "a.png", image);
    const Image<float> png = read_image(folder / "a.png");
    for (int x = 0; x < 255; ++x)
        CHECK(png.pixel(x, 0)[0] == static_cast<float>(x) / 255.0f);
    write_image(folder / "b.png", convert<long double>(image));
    CHECK(read_text(folder / "b.png") == read_text(folder / "a.png"));
    write_image(folder / "a.pfm", image);
    CHECK((read_image(folder / "a.pfm").rgb == convert<float>(image).rgb));
    write_image(folder / "a.hdr", image);
    write_image(folder / "b.hdr", convert<float>(image));
    CHECK(read_text(folder / "a.hdr") == read_text(folder / "b.hdr"));
}

TEST_CASE("a picture without three values a pixel is refused", "[image]")
{
    const TempFolder folder;
    for (const std::size_t values : {std::size_t{0}, std::size_t{35}, std::size_t{37}}) {
        Image<float> image(4, 3);
        image.rgb.resize(values);
        for (const std::string name : {"a.png", "a.pfm", "a.hdr"})
            CHECK_THROWS_WITH(write_image(folder / name, image),
                              ContainsSubstring("give three a pixel"));
        CHECK_THROWS_AS(compare(image, image), std::invalid_argument);
        CHECK_THROWS_AS(convert<double>(image), std::invalid_argument);
        CHECK_THROWS_AS(heatmap(image, Image<float>(4, 3)), std::invalid_argument);
    }
}

TEST_CASE("a picture keeps the recipe it was written with", "[image]")
{
    for (const std::string name : {"a.png", "a.pfm", "a.hdr"}) {
        CAPTURE(name);
        const TempFolder folder;
        CHECK(read_recipe(folder / name).empty());
        write_image(folder / name, gradient(5, 4));
        CHECK(read_recipe(folder / name).empty());
        const Image<float> plain = read_image(folder / name);
        write_image(folder / name, gradient(5, 4), {.recipe = "eggs, 2 of them"});
        CHECK(read_recipe(folder / name) == "eggs, 2 of them");
        CHECK((read_image(folder / name).rgb == plain.rgb));
        write_image(folder / name, gradient(5, 4), {.recipe = std::string(2000, 'x')});
        CHECK(read_recipe(folder / name) == std::string(2000, 'x'));
        // A file that was damaged later has no recipe.
        const std::string whole = read_text(folder / name);
        std::string changed = whole;
        changed[whole.size() - 20] ^= 1;
        for (const std::string& damaged : {whole.substr(0, whole.size() - 1), changed}) {
            write_text(folder / name, damaged);
            CHECK(read_recipe(folder / name).empty());
        }
        // Another picture that replaces the file has no recipe.
        write_image(folder / name, gradient(4, 5));
        CHECK(read_recipe(folder / name).empty());
        for (const std::string& bad : {std::string(2001, 'x'), "two\nlines"s, "\xc3\xa4"s})
            CHECK_THROWS_AS(write_image(folder / name, gradient(4, 5), {.recipe = bad}),
                            std::invalid_argument);
    }
}

}  // namespace packtrace
