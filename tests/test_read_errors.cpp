#include "catch.hpp"
#include "peak_memory.hpp"
#include "refusal.hpp"
#include "scene/language/grammar.hpp"
#include "scene/language/quote.hpp"
#include "scene_text.hpp"
#include "temp_folder.hpp"
#include <packtrace/read_scene.hpp>

#include <tao/pegtl/contrib/analyze.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <sys/mman.h>

// Invalid input: broken syntax, wrong values, files that are no scenes.
namespace packtrace {

using test::any_sphere;
using test::error_of;
using test::error_of_line;
using test::parse;
using test::peak_growth;
using test::refusal;
using test::TempFolder;

namespace {

std::string file_error(const std::filesystem::path& file)
{
    return refusal<SceneError>([&] { return read_scene(file); });
}

std::string repeat(const std::string& text, std::size_t count)
{
    std::string result;
    for (std::size_t i = 0; i < count; ++i)
        result += text;
    return result;
}

}  // namespace

TEST_CASE("the grammar has no rule that can loop without progress", "[read_errors]")
{
    CHECK(tao::pegtl::analyze<language::grammar::file>(-1) == 0);
}

TEST_CASE("an empty file is refused, and a scene without objects read with a warning",
          "[read_errors]")
{
    CHECK(error_of("") ==
          "x.scene:1:1: the file is empty; a scene needs an object, e.g. sphere { center = (0, 0, "
          "3) radius = 1 }");
    for (const char* text : {"\n# nothing\n", "light { type = ambient intensity = 1 }"}) {
        std::vector<std::string> warnings;
        const Scene scene = parse_scene(text, "x.scene",
                                        [&](const std::string& line) { warnings.push_back(line); });
        CHECK(scene.objects.empty());
        CHECK(warnings ==
              std::vector<std::string>{
                  "x.scene:1:1: the scene has no object, its picture is all background; add one, "
                  "e.g. sphere { center = (0, 0, 3) radius = 1 }"});
    }
}

TEST_CASE("a missing brace is reported where its block begins", "[read_errors]")
{
    CHECK(error_of("sphere {\ncenter = (0, 0, 3)\n") ==
          "x.scene:1:8: the block 'sphere' has no closing brace; end it with '}'");
    CHECK(error_of_line("sphere { center = (0, 0, 3)\nlight { type = ambient }\n") ==
          "x.scene:2:8: the block 'sphere' has no closing brace; end it with '}'");
    CHECK(error_of_line("animation { orbit { ") ==
          "x.scene:2:19: the block 'orbit' has no closing brace; end it with '}'");
    CHECK(error_of_line("}") == "x.scene:2:1: unexpected '}', no block is open here; remove it");
}

TEST_CASE("a missing sign is reported where it should be", "[read_errors]")
{
    CHECK(error_of("sphere { radius 1 }") ==
          "x.scene:1:17: expected '=' or '{' after 'radius', not '1'; write key = value or key { "
          "... }");
    CHECK(error_of_line("max_depth: 1") ==
          "x.scene:2:10: expected '=' or '{' after 'max_depth', not ':'; write key = value or key "
          "{ ... }");
    CHECK(error_of_line("max_depth") ==
          "x.scene:2:10: expected '=' or '{' after 'max_depth', not the file's end; write key = "
          "value or key { ... }");
    CHECK(error_of_line("max_depth = 1;") ==
          "x.scene:2:14: expected a key, not ';'; write key = value or key { ... }");
}

TEST_CASE("a missing value is reported where it should be", "[read_errors]")
{
    const std::string cure = "; write a number, a word, (x, y, z) or \"text\"";
    CHECK(error_of("sphere { center =\nradius = 1 }") ==
          "x.scene:2:1: expected a value for 'center', not 'radius'" + cure);
    CHECK(error_of("sphere { center = }") ==
          "x.scene:1:19: expected a value for 'center', not '}'" + cure);
    CHECK(error_of_line("max_depth = 1,") ==
          "x.scene:2:15: expected a value for 'max_depth', not the file's end" + cure);
    CHECK(error_of_line("max_depth = {") ==
          "x.scene:2:13: expected a value for 'max_depth', not '{'" + cure);
}

TEST_CASE("a broken tuple is reported where it breaks", "[read_errors]")
{
    CHECK(error_of("sphere { center = (1, 2 radius = 1 }") ==
          "x.scene:1:25: expected ',' or ')', not 'radius'; write tuples as (1, 2, 3)");
    CHECK(error_of("sphere { center = (1,, 2) }") ==
          "x.scene:1:22: expected a number, not ','; write tuples as (1, 2, 3)");
    CHECK(error_of("sphere { center = ((1, 2), 3) }") ==
          "x.scene:1:20: expected a number, not '('; write tuples as (1, 2, 3)");
    CHECK(error_of("sphere { center = (1, 2,") ==
          "x.scene:1:25: expected a number, not the file's end; write tuples as (1, 2, 3)");
}

TEST_CASE("a text without its closing quote is reported at the line's end", "[read_errors]")
{
    CHECK(error_of("cone { name = \"abc\n }") ==
          "x.scene:1:19: the text has no closing quote; end it with \" on the same line");
}

TEST_CASE("an invalid or infinite number is refused where it stands", "[read_errors]")
{
    const auto radius = [](const std::string& value) {
        return error_of("sphere { radius = " + value + " center = (0, 0, 3) }");
    };
    const std::string form = "; write it like 2, -0.5 or 1e3";
    CHECK(radius("nan") ==
          "x.scene:1:19: sphere 1: 'radius' wants a finite number, not 'nan'" + form);
    CHECK(radius("-inf") ==
          "x.scene:1:19: sphere 1: 'radius' wants a finite number, not '-inf'" + form);
    CHECK(radius("+INFINITY") ==
          "x.scene:1:19: sphere 1: 'radius' wants a finite number, not '+INFINITY'" + form);
    CHECK(radius("1abc") == "x.scene:1:19: 'radius' wants a number, not '1abc'" + form);
    CHECK(radius("0x1p3") == "x.scene:1:19: 'radius' wants a number, not '0x1p3'" + form);
    CHECK(radius("+-1") == "x.scene:1:19: 'radius' wants a number, not '+-1'" + form);
    CHECK(radius("1.2.3") == "x.scene:1:19: 'radius' wants a number, not '1.2.3'" + form);
    CHECK(radius("1e999") ==
          "x.scene:1:19: '1e999' is beyond double precision; stay within 1e-307 and 1e308");
    CHECK(error_of("sphere { center = (0, nan, 3) radius = 1 }") ==
          "x.scene:1:23: sphere 1: 'center' wants a finite number, not 'nan'" + form);
}

TEST_CASE("a value of another kind is refused with the right form", "[read_errors]")
{
    const auto sphere = [](const std::string& keys) { return error_of("sphere { " + keys + " }"); };
    CHECK(sphere("radius = (1, 2, 3) center = (0, 0, 3)") ==
          "x.scene:1:19: 'radius' wants a number; write radius = 0.5");
    CHECK(sphere("radius = \"big\" center = (0, 0, 3)") ==
          "x.scene:1:19: 'radius' wants a number; write radius = 0.5");
    CHECK(sphere("radius = 4 x 3 center = (0, 0, 3)") ==
          "x.scene:1:19: 'radius' wants a number; write radius = 0.5");
    CHECK(sphere("radius { } center = (0, 0, 3)") ==
          "x.scene:1:10: 'radius' wants a number, not a block; write radius = 0.5");
    CHECK(sphere("radius = 1, 2 center = (0, 0, 3)") ==
          "x.scene:1:22: 'radius' wants one value, not a list; write radius = 0.5");
    CHECK(sphere("center = 3") ==
          "x.scene:1:19: 'center' wants numbers in brackets; write center = (0, 1, 2)");
    CHECK(sphere("center = (1, 2)") ==
          "x.scene:1:19: 'center' wants 3 numbers, not 2; write center = (0, 1, 2)");
    CHECK(sphere("center = rgb(1, 2, 3)") ==
          "x.scene:1:19: 'center' wants numbers in brackets only; write center = (0, 1, 2)");
    CHECK(error_of_line("light = ambient") ==
          "x.scene:2:1: 'light' is a block, not a value; write light { ... }");
    CHECK(
        error_of_line("sphere ball { }") ==
        "x.scene:2:8: only a material is named before its brace; write name = \"...\" between the "
        "braces of an object");
}

TEST_CASE("an unknown key is refused with the nearest known one", "[read_errors]")
{
    CHECK(error_of_line("max_deph = 3") ==
          "x.scene:2:1: unknown key 'max_deph' in the scene; did you mean 'max_depth'?");
    CHECK(error_of_line("light { typ = ambient }") ==
          "x.scene:2:9: unknown key 'typ' in light; did you mean 'type'?");
    CHECK(error_of_line("light { color = (1, 1, 1) }") ==
          "x.scene:2:9: unknown key 'color' in light; use one of: type, intensity, position, "
          "direction, casts_shadow");
    CHECK(error_of_line("spheer { }") ==
          "x.scene:2:1: unknown key 'spheer' in the scene; did you mean 'sphere'?");
}

TEST_CASE("a key given twice is refused at the second", "[read_errors]")
{
    CHECK(error_of("sphere { radius = 1\ncenter = (0, 0, 3) radius = 2 }") ==
          "x.scene:2:20: 'radius' is given twice, first on line 1; remove one of them");
    CHECK(error_of_line("max_depth = 1\nmax_depth = 1") ==
          "x.scene:3:1: 'max_depth' is given twice, first on line 2; remove one of them");
}

TEST_CASE("the scene's own keys have limits", "[read_errors]")
{
    CHECK(error_of_line("max_depth = -1") ==
          "x.scene:2:13: 'max_depth' is -1; use a whole number from 0 to 64");
    CHECK(error_of_line("max_depth = 65") ==
          "x.scene:2:13: 'max_depth' is 65; use a whole number from 0 to 64");
    CHECK(error_of_line("max_depth = 2.5") ==
          "x.scene:2:13: 'max_depth' is 2.5; use a whole number from 0 to 64");
    CHECK(error_of_line("image_size = 0 x 480") ==
          "x.scene:2:14: 'image_size' has a side of 0 pixels; use a whole number from 1 to 65536");
    CHECK(error_of_line("image_size = 640 x 65537") ==
          "x.scene:2:20: 'image_size' has a side of 65537 pixels; use a whole number from 1 to "
          "65536");
    CHECK(error_of_line("image_size = 640.5 x 480") ==
          "x.scene:2:14: 'image_size' has a side of 640.5 pixels; use a whole number from 1 to "
          "65536");
    CHECK(error_of_line("image_size = (640, 480)") ==
          "x.scene:2:14: 'image_size' wants a width and a height; write image_size = 4 x 3");
    CHECK(error_of_line("viewport_size = 1 x -1") ==
          "x.scene:2:21: 'viewport_size' has a side of -1; use a number above 0");
    CHECK(error_of_line("projection_plane_d = 0") ==
          "x.scene:2:22: 'projection_plane_d' is 0; use a number above 0");
    CHECK(error_of_line("pixel_sample = (0.5, 1.5)") ==
          "x.scene:2:22: 'pixel_sample' is 1.5; use a number from 0 to 1");
}

TEST_CASE("the largest permitted values are accepted", "[read_errors]")
{
    const Scene scene = test::parse_with_sphere("max_depth = 64 image_size = 65536 x 1");
    CHECK(scene.max_depth == 64);
    CHECK(scene.width == 65536);
    CHECK(scene.height == 1);
}

TEST_CASE("an unknown word is refused with the known ones", "[read_errors]")
{
    CHECK(error_of_line("illumination = phong") ==
          "x.scene:2:16: unknown illumination 'phong'; use one of: scratch, sketch, whitted, "
          "shader, general");
    CHECK(error_of_line("illumination = scrath") ==
          "x.scene:2:16: unknown illumination 'scrath'; did you mean 'scratch'?");
    CHECK(error_of_line("shadows = soft") ==
          "x.scene:2:11: unknown shadows 'soft'; use one of: none, opaque, transparent");
    CHECK(error_of_line("shadows = \"none\"") ==
          "x.scene:2:11: 'shadows' wants one word; write shadows = none");
}

TEST_CASE("the depth limit's rule belongs to the general model only", "[read_errors]")
{
    CHECK(error_of_line("depth_limit = local") ==
          "x.scene:2:1: 'depth_limit' belongs to illumination = general, the other models have a "
          "rule of their own; remove it");
}

TEST_CASE("a light without a direction is refused", "[read_errors]")
{
    CHECK(error_of_line("light { type = point intensity = 1 }") ==
          "x.scene:2:1: light has no 'position'; add for example position = (2, 1, 0)");
    CHECK(error_of_line("light { type = directional intensity = 1 }") ==
          "x.scene:2:1: light has no 'direction'; add for example direction = (1, 4, 4)");
    CHECK(error_of_line("light { type = directional intensity = 1 direction = (0, 0, 0) }") ==
          "x.scene:2:54: light 1: 'direction' is (0, 0, 0), which points nowhere; use a vector of "
          "any other "
          "length");
    CHECK(error_of_line("light { intensity = 1 }") ==
          "x.scene:2:1: light has no 'type'; add for example type = point");
    CHECK(error_of_line("light { type = ambient }") ==
          "x.scene:2:1: light has no 'intensity'; add for example intensity = 0.6");
}

TEST_CASE("a light's keys belong to its type", "[read_errors]")
{
    CHECK(error_of_line("light { type = ambient intensity = 1 position = (0, 0, 0) }") ==
          "x.scene:2:38: light 1: only a point light has a position; remove it");
    CHECK(error_of_line("light { type = point intensity = 1 position = (0, 0, 0)\n"
                        "direction = (0, 0, 1) }") ==
          "x.scene:3:1: only a directional light has a direction; remove it");
    CHECK(error_of_line("light { type = ambient intensity = -0.5 }") ==
          "x.scene:2:36: light 1: 'intensity' is -0.5; use a number of 0 or more");
    CHECK(error_of_line("light { type = spot intensity = 1 }") ==
          "x.scene:2:16: unknown type 'spot'; use one of: ambient, point, directional");
}

TEST_CASE("a carriage return alone does not end a line", "[read_errors]")
{
    CHECK_NOTHROW(parse_scene("# c\r\nsphere { center = (0, 0, 3)  radius = 1 }\r\n", "t", {}));
    CHECK_THAT(error_of("# c\rsphere { }\rsphere { center = (0, 0, 5) }\r"),
               Catch::Matchers::StartsWith("x.scene:1:4: a carriage return"));
}

TEST_CASE("a binary file is refused at its first strange byte", "[read_errors]")
{
    const std::string cure = " does not belong in text; is this a binary file? give a scene file";
    CHECK(error_of(std::string("\x89PNG\r\n\x1a\n", 8)) == "x.scene:2:1: the byte '\\x1a'" + cure);
    CHECK(error_of(std::string("ab\0c", 4)) == "x.scene:1:3: the byte '\\x00'" + cure);
}

TEST_CASE("messages hold no control bytes and no enormous words", "[read_errors]")
{
    CHECK(error_of_line("caf\xe9 = 1") ==
          "x.scene:2:4: expected '=' or '{' after 'caf', not '\\xe9'; write key = value or key { "
          "... }");
    CHECK(error_of_line("größe = 1") ==
          "x.scene:2:3: expected '=' or '{' after 'gr', not 'öße'; write key = value or key { ... "
          "}");
    CHECK(error_of_line("illumination = " + std::string(1000, 'y')) ==
          "x.scene:2:16: unknown illumination '" + std::string(40, 'y') +
              "...'; use one of: scratch, sketch, whitted, shader, general");
    CHECK(refusal<SceneError>([] {
              return parse_scene("", "a\nb\x1b[31m.scene");
          }).starts_with("a\\x0ab\\x1b[31m.scene:1:1: "));
}

TEST_CASE("quoting keeps whole characters and escapes invalid bytes", "[read_errors]")
{
    using language::quote;
    CHECK(quote("a b") == "'a b'");
    CHECK(quote("\x7f\t") == "'\\x7f\\x09'");
    CHECK(quote("\xc3\xa4\xe2\x82\xac\xf0\x9f\x8d\x80") ==
          "'\xc3\xa4\xe2\x82\xac\xf0\x9f\x8d\x80'");
    CHECK(quote("\xc3") == "'\\xc3'");
    CHECK(quote("\xc2\x9b") == "'\\xc2\\x9b'");
    CHECK(quote("\xff\x80") == "'\\xff\\x80'");
    // Invisible characters: a no-break space, a byte order mark, a mark of direction.
    CHECK(quote("\xc2\xa0") == "'\\xc2\\xa0'");
    CHECK(quote("\xef\xbb\xbf") == "'\\xef\\xbb\\xbf'");
    CHECK(quote("\xe2\x80\xae") == "'\\xe2\\x80\\xae'");
    CHECK(quote(std::string(39, 'a') + "\xc3\xa4") == "'" + std::string(39, 'a') + "...'");
    CHECK(quote(std::string(40, 'a')) == "'" + std::string(40, 'a') + "'");
}

TEST_CASE("a word's nearest neighbour differs by at most two typing errors", "[read_errors]")
{
    constexpr std::string_view known[] = {"radius", "center", "up"};
    using language::nearest_word;
    CHECK(nearest_word("raduis", known) == "radius");
    CHECK(nearest_word("radi", known) == "radius");
    CHECK(nearest_word("rad", known).empty());
    CHECK(nearest_word("cnetre", known) == "center");
    CHECK(nearest_word("ip", known) == "up");
    CHECK(nearest_word("xy", known).empty());
    CHECK(nearest_word("radiuses", known) == "radius");
    CHECK(nearest_word(std::string(1000, 'r'), known).empty());
}

TEST_CASE("blocks nested in blocks are refused at any depth", "[read_errors]")
{
    const std::string message =
        "blocks stand too deep in each other; close an outer one with '}' "
        "first";
    CHECK(error_of("a { b { c { d { } } } }") == "x.scene:1:15: " + message);
    CHECK(error_of(repeat("a{", 400'000)) == "x.scene:1:8: " + message);
    CHECK(error_of("a = " + std::string(400'000, '(')) ==
          "x.scene:1:6: expected a number, not '('; write tuples as (1, 2, 3)");
    CHECK(error_of(std::string(400'000, '{')) ==
          "x.scene:1:1: expected a key, not '{'; write key = value or key { ... }");
}

TEST_CASE("a value is no longer than any key needs", "[read_errors]")
{
    CHECK(error_of_line("max_depth = (" + repeat("1,", 64) + "1)") ==
          "x.scene:2:142: more than 64 numbers in a tuple; remove some");
    CHECK(error_of_line("max_depth = " + repeat("1,", 65536) + "1") ==
          "x.scene:2:131085: more than 65536 items in a value; remove some");
}

TEST_CASE("a line too long is refused before it is parsed", "[read_errors]")
{
    const std::string longest((1u << 20u) - 1, 'x');
    CHECK(error_of("#" + longest + "\n" + any_sphere) == "accepted");
    CHECK(error_of("\n#x" + longest) ==
          "x.scene:2:1048577: the line has more than 1048576 bytes; break it into several");
}

TEST_CASE("a line of 100 MB is refused without being read whole", "[read_errors]")
{
    const TempFolder folder;
    const std::filesystem::path file = folder / "long_line.scene";
    std::ofstream(file).put('x');
    std::filesystem::resize_file(file, 100'000'000);
    std::string message;
    const long growth = peak_growth([&] { message = file_error(file); });
    CHECK(message == file.string() +
                         ":1:1048577: the line has more than 1048576 bytes; break it into several");
    CHECK(growth < 50'000);
}

TEST_CASE("a text of more than 1 GiB is no scene", "[read_errors]")
{
    // Reserved memory that is never touched.
    constexpr std::size_t size = (std::size_t{1} << 30u) + 1;
    void* memory =
        mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    const std::string message = refusal<SceneError>([&] {
        return parse_scene({static_cast<const char*>(memory), size}, "x.scene");
    });
    munmap(memory, size);
    CHECK(message == "x.scene:1:1: the file has more than 1 GiB; give a smaller scene");
}

TEST_CASE("a file that can't be opened is named", "[read_errors]")
{
    CHECK(file_error("/nonexistent/a.scene") ==
          "/nonexistent/a.scene: can't be opened (No such file or directory); check the name and "
          "the permissions");
    CHECK(file_error("/") == "/: this is a directory; give a scene file");
}

TEST_CASE("eight million keys are more than a scene can have", "[read_errors][slow]")
{
    CHECK(error_of(repeat("a=1\n", 8'000'001)) ==
          "x.scene:8000001:1: more than 8000000 keys in a file; remove some");
}

}  // namespace packtrace
