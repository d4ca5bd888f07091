#include "catch.hpp"
#include "scene_text.hpp"
#include <packtrace/read_scene.hpp>

// Materials of each illumination, named and inline, and checkers.
namespace packtrace {

using test::error_of;
using test::error_of_line;
using test::parse;

namespace {

/// The material of a sphere with `keys` in a scene lit by `illumination`.
Material sphere_material(const std::string& illumination, const std::string& keys)
{
    return parse("illumination = " + illumination + "\nsphere { center = (0, 0, 3) radius = 1\n" +
                 keys + " }")
        .objects[0]
        .material;
}

std::string sphere_error(const std::string& illumination, const std::string& keys)
{
    return error_of("illumination = " + illumination +
                    "\nsphere { center = (0, 0, 3) radius = 1\n" + keys + " }");
}

}  // namespace

TEST_CASE("a material without keys is white and matte", "[read_material]")
{
    const Material material = sphere_material("scratch", "");
    CHECK(material.color == Rgb(1.0));
    CHECK(material.name.empty());
    CHECK_FALSE(material.checker.has_value());
    CHECK(std::get<ScratchMaterial>(material.model).specular == -1.0);
    CHECK(std::get<ScratchMaterial>(material.model).reflective == 0.0);
}

TEST_CASE("scratch takes an exponent and a reflective share", "[read_material]")
{
    const Material material =
        sphere_material("scratch", "color = (51, 0, 255) specular = 500 reflective = 0.25");
    CHECK(material.color == Rgb(0.2, 0.0, 1.0));
    CHECK(std::get<ScratchMaterial>(material.model).specular == 500.0);
    CHECK(std::get<ScratchMaterial>(material.model).reflective == 0.25);
    const Material dull = sphere_material("scratch", "specular = -1");
    CHECK(std::get<ScratchMaterial>(dull.model).specular == -1.0);
}

TEST_CASE("sketch takes Ka, Kd, Ks, Kr, S and ior", "[read_material]")
{
    const Material material = sphere_material(
        "sketch",
        "color = (255, 0, 0) ambient = 0.1 diffuse = (0.2, 0.3, 0.4) specular = 0.5\n"
        "refractive = 0.6 shininess = 20 ior = 1.5");
    CHECK(material.color == Rgb(1.0, 0.0, 0.0));
    const auto& model = std::get<SketchMaterial>(material.model);
    CHECK(model.ambient == Rgb(0.1));
    CHECK(model.diffuse == Rgb(0.2, 0.3, 0.4));
    CHECK(model.specular == Rgb(0.5));
    CHECK(model.refractive == Rgb(0.6));
    CHECK(model.shininess == 20.0);
    CHECK(model.ior == 1.5);
}

TEST_CASE("whitted takes ambient, kd, ks, kt, n and ior", "[read_material]")
{
    const Material material = sphere_material(
        "whitted",
        "color = (0, 255, 0) ambient = 0.1 diffuse = 0.2 specular = (0.3, 0.4, 0.5)\n"
        "transmissive = 0.6 shininess = 30 ior = 1.25");
    CHECK(material.color == Rgb(0.0, 1.0, 0.0));
    const auto& model = std::get<WhittedMaterial>(material.model);
    CHECK(model.ambient == Rgb(0.1));
    CHECK(model.diffuse == Rgb(0.2));
    CHECK(model.specular == Rgb(0.3, 0.4, 0.5));
    CHECK(model.transmissive == Rgb(0.6));
    CHECK(model.shininess == 30.0);
    CHECK(model.ior == 1.25);
}

TEST_CASE("shader takes note 004's four reflectances", "[read_material]")
{
    const Material material =
        sphere_material("shader", "color = (0, 0, 255) reflectance = (0.1, 0.7, 0.2, 16)");
    CHECK(material.color == Rgb(0.0, 0.0, 1.0));
    CHECK(std::get<ShaderMaterial>(material.model).reflectance ==
          std::array<double, 4>{0.1, 0.7, 0.2, 16.0});
}

TEST_CASE("general takes the equation's own coefficients", "[read_material]")
{
    const Material material = sphere_material(
        "general",
        "ambient = (0.1, 0.2, 0.3) diffuse = 0.4 highlight = 0.5 reflect = (0.6, 0.7, 0.8)\n"
        "transmit = rgb(0.25, 0.5, 0.75) shininess = 40 ior = 1.125");
    const auto& model = std::get<GeneralMaterial>(material.model);
    CHECK(model.ambient == Rgb(0.1, 0.2, 0.3));
    CHECK(model.diffuse == Rgb(0.4));
    CHECK(model.highlight == Rgb(0.5));
    CHECK(model.reflect == Rgb(0.6, 0.7, 0.8));
    CHECK(model.transmit == Rgb(0.25, 0.5, 0.75));
    CHECK(model.shininess == 40.0);
    CHECK(model.ior == 1.125);
}

TEST_CASE("a material without keys belongs to the scene's model", "[read_material]")
{
    CHECK(std::holds_alternative<SketchMaterial>(sphere_material("sketch", "").model));
    CHECK(std::holds_alternative<WhittedMaterial>(sphere_material("whitted", "").model));
    CHECK(std::holds_alternative<ShaderMaterial>(sphere_material("shader", "").model));
    const Material general = sphere_material("general", "");
    CHECK(std::get<GeneralMaterial>(general.model).shininess == 1.0);
    CHECK(std::get<GeneralMaterial>(general.model).ior == 1.0);
}

TEST_CASE("material, use and illumination may come in any order", "[read_material]")
{
    const Scene scene = parse(
        "sphere { center = (0, 0, 3) radius = 1 material = glass }\n"
        "sphere { center = (2, 0, 3) radius = 1 material = \"dark glass\" }\n"
        "material glass { transmissive = 0.8 ior = 1.5 }\n"
        "material \"dark glass\" { transmissive = 0.3 }\n"
        "illumination = whitted\n");
    CHECK(scene.objects[0].material.name == "glass");
    CHECK(std::get<WhittedMaterial>(scene.objects[0].material.model).transmissive == Rgb(0.8));
    CHECK(std::get<WhittedMaterial>(scene.objects[0].material.model).ior == 1.5);
    CHECK(scene.objects[1].material.name == "dark glass");
    CHECK(std::get<WhittedMaterial>(scene.objects[1].material.model).transmissive == Rgb(0.3));
}

TEST_CASE("a plane's checker gives both its colours and the squares' edge", "[read_material]")
{
    const Scene scene = parse(
        "plane { point = (0, -1, 0) normal = (0, 1, 0)\n"
        "        checker = (255, 255, 255), rgb(0.25, 0.5, 0.75), 2.5 reflective = 0.5 }");
    const Material& material = scene.objects[0].material;
    CHECK(material.color == Rgb(1.0));
    REQUIRE(material.checker.has_value());
    CHECK(material.checker->other == Rgb(0.25, 0.5, 0.75));
    CHECK(material.checker->size == 2.5);
    CHECK(std::get<ScratchMaterial>(material.model).reflective == 0.5);
}

TEST_CASE("a checker lies over a named material's colour", "[read_material]")
{
    const Scene scene = parse(
        "material shiny { color = (255, 0, 0) reflective = 0.5 }\n"
        "plane { point = (0, 0, 0) normal = (0, 1, 0) material = shiny\n"
        "        checker = (0, 255, 0), (0, 0, 255), 1 }\n"
        "plane { point = (0, 9, 0) normal = (0, 1, 0) material = shiny }");
    CHECK(scene.objects[0].material.color == Rgb(0.0, 1.0, 0.0));
    CHECK(scene.objects[0].material.checker->other == Rgb(0.0, 0.0, 1.0));
    CHECK(scene.objects[1].material.color == Rgb(1.0, 0.0, 0.0));
    CHECK_FALSE(scene.objects[1].material.checker.has_value());
}

TEST_CASE("an unknown material is named with its position and a remedy", "[read_material]")
{
    CHECK(error_of_line("sphere { center = (0, 0, 3) radius = 1 material = gold }") ==
          "x.scene:2:51: unknown material 'gold'; define it with: material gold { ... }");
    CHECK(error_of("material glass { }\nsphere { center = (0, 0, 3) radius = 1\n"
                   "material = glas }") ==
          "x.scene:3:12: unknown material 'glas'; did you mean 'glass'?");
}

TEST_CASE("a material needs a name of its own", "[read_material]")
{
    CHECK(error_of_line("material { color = (255, 0, 0) }") ==
          "x.scene:2:1: the material has no name; write material gold { ... }");
    CHECK(error_of_line("material gold { }\nmaterial gold { }") ==
          "x.scene:3:10: material 'gold' is defined twice, first on line 2; give one of them "
          "another name");
    CHECK(error_of_line("material = gold") ==
          "x.scene:2:1: 'material' is a block, not a value; write material gold { ... }");
}

TEST_CASE("keys beside a named material override its own", "[read_material]")
{
    const Scene scene = parse(
        "material red { color = (255, 0, 0) reflective = 0.25 }\n"
        "sphere { center = (0, 0, 3) radius = 1 material = red  specular = 10 }\n"
        "sphere { center = (0, 0, 3) radius = 1 material = red  color = (0, 0, 255) }\n"
        "sphere { center = (0, 0, 3) radius = 1 material = red }");
    const auto model = [&](std::size_t i) {
        return std::get<ScratchMaterial>(scene.objects[i].material.model);
    };
    CHECK(scene.objects[0].material.color == Rgb(1.0, 0.0, 0.0));
    CHECK(model(0).specular == 10.0);
    CHECK(model(0).reflective == 0.25);
    CHECK(scene.objects[1].material.color == Rgb(0.0, 0.0, 1.0));
    CHECK(model(1).specular == -1.0);
    CHECK(scene.objects[2].material.color == Rgb(1.0, 0.0, 0.0));
    CHECK(model(2).specular == -1.0);
    for (const Object& object : scene.objects)
        CHECK(object.material.name == "red");
}

TEST_CASE("an error in a material is reported where the material is, used or not",
          "[read_material]")
{
    const std::string bad = "material bad { reflective = 2 }\n";
    const std::string message =
        "x.scene:1:29: material 'bad': 'reflective' is 2; use a number from 0 to 1";
    CHECK(error_of(bad + test::any_sphere) == message);
    CHECK(error_of(bad + "sphere { center = (0, 0, 3) radius = 1 material = bad }") == message);
}

TEST_CASE("a key of another model is distinguished from an unknown key", "[read_material]")
{
    CHECK(sphere_error("scratch", "diffuse = 0.5") ==
          "x.scene:3:1: 'diffuse' is no material key under illumination = scratch; use color, "
          "specular, reflective, or another illumination");
    CHECK(sphere_error("general", "color = (255, 0, 0)") ==
          "x.scene:3:1: 'color' is no material key under illumination = general; use ambient, "
          "diffuse, highlight, reflect, transmit, shininess, ior, or another illumination");
    CHECK(error_of("material m { transmissive = 1 }\nillumination = sketch\n") ==
          "x.scene:1:14: 'transmissive' is no material key under illumination = sketch; use "
          "color, ambient, diffuse, specular, refractive, shininess, ior, or another "
          "illumination");
    CHECK(sphere_error("sketch", "shinyness = 5") ==
          "x.scene:3:1: unknown key 'shinyness' in sphere; did you mean 'shininess'?");
}

TEST_CASE("coefficients out of range are refused at the number", "[read_material]")
{
    CHECK(sphere_error("scratch", "reflective = 1.5") ==
          "x.scene:3:14: sphere 1: 'reflective' is 1.5; use a number from 0 to 1");
    CHECK(sphere_error("scratch", "specular = -2") ==
          "x.scene:3:12: sphere 1: 'specular' is -2; use an exponent of 0 or more, or -1 for no "
          "highlight");
    CHECK(sphere_error("sketch", "ior = -1.5") ==
          "x.scene:3:7: sphere 1: 'ior' is -1.5; use a number above 0");
    CHECK(sphere_error("whitted", "ior = 0") ==
          "x.scene:3:7: sphere 1: 'ior' is 0; use a number above 0");
    CHECK(sphere_error("whitted", "diffuse = (0.5, -0.5, 0)") ==
          "x.scene:3:17: sphere 1: 'diffuse' is -0.5; use a number of 0 or more");
    CHECK(sphere_error("shader", "reflectance = (0, 1, -2, 3)") ==
          "x.scene:3:22: sphere 1: 'reflectance' is -2; use a number of 0 or more");
    CHECK(sphere_error("shader", "reflectance = (0, 1, 2)") ==
          "x.scene:3:15: 'reflectance' wants 4 numbers, not 3; write reflectance = (0.2, 0.6, 0.2, "
          "16)");
    CHECK(sphere_error("general", "shininess = -1") ==
          "x.scene:3:13: sphere 1: 'shininess' is -1; use a number of 0 or more");
}

TEST_CASE("colours out of range or of another form are refused", "[read_material]")
{
    CHECK(sphere_error("scratch", "color = (0, 256, 0)") ==
          "x.scene:3:13: sphere 1: 'color' is 256; use a number from 0 to 255");
    CHECK(sphere_error("scratch", "color = rgb(0, 0, 1.5)") ==
          "x.scene:3:19: sphere 1: 'color' is 1.5; use a number from 0 to 1");
    CHECK(sphere_error("scratch", "color = hsv(0, 0, 1)") ==
          "x.scene:3:9: 'color' wants a colour; write color = (255, 128, 0) or rgb(1, 0.5, 0)");
    CHECK(sphere_error("scratch", "color = red") ==
          "x.scene:3:9: 'color' wants a colour; write color = (255, 128, 0) or rgb(1, 0.5, 0)");
    CHECK(sphere_error("sketch", "diffuse = \"much\"") ==
          "x.scene:3:11: 'diffuse' wants a number or one for each channel; write diffuse = 0.5 or "
          "(0.5, 0.4, 0.3)");
}

TEST_CASE("an invalid checker is refused", "[read_material]")
{
    const std::string plane = "plane { point = (0, 0, 0) normal = (0, 1, 0)\n";
    CHECK(error_of(plane + "checker = (0, 0, 0), (1, 1, 1), 0 }") ==
          "x.scene:2:33: plane 1: 'checker' is 0; use a number above 0");
    CHECK(error_of(plane + "checker = (0, 0, 0), (1, 1, 1) }") ==
          "x.scene:2:1: 'checker' wants two colours and a size; write checker = (255, 255, 255), "
          "(0, 0, 0), 1");
    CHECK(error_of(plane + "checker = (0, 0, 0), 1, (1, 1, 1) }") ==
          "x.scene:2:22: 'checker' wants a colour; write checker = (255, 255, 255), (0, 0, 0), 1");
    CHECK(error_of(plane + "color = (1, 1, 1) checker = (0, 0, 0), (1, 1, 1), 1 }") ==
          "x.scene:2:1: 'checker' gives both colours; remove 'color'");
    CHECK(error_of_line("cone { checker = (0, 0, 0), (1, 1, 1), 1 }") ==
          "x.scene:2:8: cone 1: only a plane can have a checker; remove it and use color");
    CHECK(error_of("illumination = general\n" + plane + "checker = (0, 0, 0), (1, 1, 1), 1 }") ==
          "x.scene:3:1: plane 1: 'checker' has no effect under illumination = general, whose "
          "coefficients "
          "know no colour; remove it");
}

}  // namespace packtrace
