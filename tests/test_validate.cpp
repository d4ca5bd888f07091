#include "catch.hpp"
#include "random_scenes.hpp"
#include "same_scene.hpp"
#include "scene_text.hpp"
#include <packtrace/build.hpp>
#include <packtrace/render.hpp>
#include <packtrace/validate.hpp>
#include <packtrace/write_scene.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

// The messages of validate() about scenes built in code, the ends of its ranges, and the helpers
// that build scenes.
namespace packtrace::test {
namespace {

std::string fault_of(const Scene& scene)
{
    return refusal<SceneError>([&] { validate(scene); });
}

Scene scene_of(std::vector<Object> objects)
{
    Scene scene = make_scene(Illumination::scratch);
    scene.objects = std::move(objects);
    return scene;
}

std::string fault_of(const Surface& surface)
{
    return fault_of(scene_of({make_object(surface)}));
}

/// Throws during an emplace, which leaves its variant without a value.
struct FailingPolygon {
    operator Polygon() const
    {
        throw std::runtime_error("no polygon");
    }
};

/// A number that a range permits: one of its ends, or one between them.
double extreme(RandomScene& random, double smallest, double largest)
{
    const double numbers[] = {smallest, largest, std::sqrt(smallest * largest), 1.0};
    return numbers[random.below(4)];
}

double far(RandomScene& random)
{
    return (random.chance(0.5) ? 1.0 : -1.0) * extreme(random, 1e-3, 1e13);
}

Vec3 far_point(RandomScene& random)
{
    return {far(random), far(random), random.chance(0.5) ? 3.0 : far(random)};
}

Surface extreme_surface(RandomScene& random)
{
    const double size = extreme(random, 1e-15, 1e11);
    switch (random.below(4)) {
        case 0:
            return packtrace::sphere(far_point(random), size);
        case 1:
            return packtrace::plane(far_point(random), random.vector(1.0) + Vec3(0, 0, 1.1));
        case 2:
            return packtrace::polygon({{-size, -size, 3}, {size, -size, 3}, {0, size, 3}});
        default:
            return clip_and_cap(packtrace::quadric(static_cast<QuadricKind>(random.below(7))), -1,
                                1);
    }
}

Object extreme_object(RandomScene& random, Illumination illumination)
{
    Object object = make_object(extreme_surface(random), make_material(illumination));
    if (std::holds_alternative<Quadric>(object.surface))
        object = translate(packtrace::scale(object, extreme(random, 1e-14, 1e11)),
                           0.5 * far_point(random));
    const double factor = extreme(random, 1e-9, 1e9);
    const double ior = extreme(random, 0.1, 10);
    if (auto* general = std::get_if<GeneralMaterial>(&object.material.model))
        *general = {Rgb(factor), Rgb(factor), Rgb(1.0), Rgb(0.5), Rgb(0.5), 1e4, ior};
    if (auto* whitted = std::get_if<WhittedMaterial>(&object.material.model))
        *whitted = {Rgb(factor), Rgb(factor), Rgb(0.5), Rgb(0.5), 1e4, ior};
    return object;
}

Scene extreme_scene(unsigned seed)
{
    RandomScene random(seed);
    const auto illumination = random.chance(0.5) ? Illumination::general : Illumination::whitted;
    Scene scene = make_scene(illumination);
    set_size(scene, 9, 9);
    scene.shadows = static_cast<ShadowKind>(random.below(3));
    scene.camera.position = random.chance(0.5) ? Vec3(0.0) : far_point(random);
    if (random.chance(0.3))
        scene.camera.fov = random.chance(0.5) ? 1e-9 : 179.9999999;
    else
        scene.camera.viewport = Vec2(extreme(random, 1e-15, 1e13));
    if (random.chance(0.3))
        scene.camera.distance = extreme(random, 1e-15, 1e13);
    const int objects = 1 + random.below(50);
    for (int i = 0; i < objects; ++i)
        scene.objects.push_back(extreme_object(random, illumination));
    scene.lights = {packtrace::point_light(far_point(random), Rgb(extreme(random, 1e-9, 1e9))),
                    directional_light(far_point(random), Rgb(1.0)), ambient_light(Rgb(0.5))};
    return scene;
}

template <class Real>
void check_picture(const Scene& scene, Kernel kernel)
{
    const Image<Real> picture = render<Real>(scene, {.kernel = kernel});
    for (const Real value : picture.rgb)
        if (!std::isfinite(value))
            FAIL((kernel == Kernel::packet ? "packets" : "scalar")
                 << " of " << sizeof(Real) << " bytes:\n"
                 << scene_text(scene));
}

}  // namespace

TEST_CASE("a fault is named with its object and a remedy", "[validate]")
{
    const Object good = make_object(packtrace::sphere({0, 0, 3}, 1));
    const Object bad = make_object(packtrace::sphere({0, 0, 3}, -1));
    CHECK(fault_of(scene_of({good, good})) == "accepted");
    CHECK(fault_of(scene_of({good, make_object(cone()), bad})) ==
          "sphere 2: 'radius' is -1; use a number above 0");
    Object named = bad;
    named.name = "ball";
    CHECK(fault_of(scene_of({named})) == "sphere 'ball': 'radius' is -1; use a number above 0");
    Scene scene = scene_of({good});
    scene.lights = {ambient_light(Rgb(0.1)), ambient_light(Rgb(-1.0))};
    CHECK(fault_of(scene) == "light 2: 'intensity' is -1; use a number of 0 or more");
    scene = scene_of({good});
    scene.max_depth = 65;
    CHECK(fault_of(scene) == "'max_depth' is 65; use a whole number from 0 to 64");
}

TEST_CASE("a surface that an exception left without a value is refused", "[validate]")
{
    const Object good = make_object(packtrace::sphere({0, 0, 3}, 1));
    Scene scene = scene_of({good, good});
    CHECK_THROWS(scene.objects[1].surface.emplace<Polygon>(FailingPolygon()));
    REQUIRE(scene.objects[1].surface.valueless_by_exception());
    CHECK(fault_of(scene) ==
          "object 2: an exception left 'surface' without a value; assign it one");
    scene.objects[1].name = "ball";
    CHECK(fault_of(scene) ==
          "object 'ball': an exception left 'surface' without a value; assign it one");
    scene.objects[1].surface = good.surface;
    CHECK(fault_of(scene) == "accepted");
}

TEST_CASE("a quadric is complete or refused", "[validate]")
{
    CHECK(fault_of(ellipsoid()) == "accepted");
    Quadric bare{.kind = QuadricKind::ellipsoid};
    CHECK(fault_of(bare) ==
          "ellipsoid 1: the coefficients are not those of the quadric's kind; fill them in, as "
          "ellipsoid(), cone() and so on do, or make the kind general");
    CHECK(fault_of(packtrace::quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, 1})) ==
          "quadric 1: the quadric has no surface: no point satisfies its equation; change its "
          "coefficients");
}

TEST_CASE("of several faults the first object's is reported", "[validate]")
{
    Scene scene = scene_of({});
    for (int i = 0; i < 50'000; ++i)
        scene.objects.push_back(make_object(packtrace::sphere({0, 0, i}, i < 30'000 ? 1 : -i)));
    for (int i = 0; i < 20; ++i)
        CHECK(fault_of(scene) == "sphere 30001: 'radius' is -30000; use a number above 0");
}

TEST_CASE("ranges end where single precision does", "[validate]")
{
    const auto ball = [](double x, double radius) {
        return fault_of(packtrace::sphere({x, 0, 3}, radius));
    };
    CHECK(ball(1e13, 1) == "accepted");
    CHECK(
        ball(-2e13, 1) ==
        "sphere 1: 'center' is -20000000000000, too large for single precision; use at most 1e+13 "
        "in "
        "size");
    CHECK(ball(0, 1e13) == "accepted");
    CHECK(ball(0, 1e-15) == "accepted");
    CHECK(
        ball(0, 9e-16) ==
        "sphere 1: 'radius' is 9e-16, too small for single precision; use at least 1e-15 in size");
    const Object unit = make_object(packtrace::sphere({1, 0, 0}, 1e-3));
    CHECK(fault_of(scene_of({translate(unit, {9e12, 0, 0})})) == "accepted");
    CHECK(fault_of(scene_of({translate(packtrace::scale(unit, 9e12), {9e12, 0, 0})})) ==
          "sphere 1: the transform takes it to (18000000000000, 0, 0), too far for single "
          "precision; stay "
          "within 1e+13 of the origin");
    CHECK(fault_of(scene_of({packtrace::scale(unit, 1e-13)})) ==
          "sphere 1: the transform makes its size 1.0000000000000001e-16, too small for single "
          "precision; stay "
          "within 1e-15 and 1e+13");
}

TEST_CASE("factors above 1 are refused where colours may outgrow single precision", "[validate]")
{
    Scene scene = make_scene(Illumination::general);
    Material bright = make_material(Illumination::general);
    std::get<GeneralMaterial>(bright.model).reflect = Rgb(2.0);
    scene.objects = {make_object(packtrace::sphere({0, 0, 3}, 1), bright)};
    scene.max_depth = 64;
    CHECK(fault_of(scene) == "accepted");
    std::get<GeneralMaterial>(scene.objects[0].material.model).transmit = Rgb(2.0);
    CHECK(fault_of(scene) ==
          "sphere 1: factors above 1 let colours grow to 1e41, beyond single precision: it mirrors "
          "and lets through 4 times the light, at max_depth = 64; use smaller factors or a lower "
          "max_depth");
    scene.max_depth = 50;
    CHECK(fault_of(scene) == "accepted");
}

TEST_CASE("numbers at the ends of their ranges give pictures without NaN", "[validate]")
{
    for (unsigned seed = 1; seed <= 300; ++seed) {
        const Scene scene = extreme_scene(seed);
        INFO("seed " << seed);
        if (fault_of(scene) != "accepted")
            FAIL(fault_of(scene));
        check_picture<float>(scene, Kernel::packet);
        check_picture<double>(scene, Kernel::packet);
        check_picture<double>(scene, Kernel::scalar);
    }
}

TEST_CASE("a scene with more keys than a file may have has no text", "[validate][slow]")
{
    // Six keys each: the sphere itself, its centre, radius, colour, highlight and mirrored share.
    const Object object = make_object(packtrace::sphere({0, 0, 3}, 1));
    Scene scene = scene_of({});
    scene.objects.assign(1'300'000, object);
    CHECK(parse(scene_text(scene)).objects.size() == 1'300'000);
    scene.objects.assign(1'400'000, object);
    CHECK_THROWS_WITH(scene_text(scene), ContainsSubstring("keep it within 8000000 keys"));
}

TEST_CASE("helpers build the same objects as the language's words", "[validate]")
{
    const auto check = [](const Object& built, const std::string& text) {
        INFO(text);
        CHECK(same(scene_of({built}), parse(text)));
    };
    check(make_object(packtrace::sphere({0, 1, 3}, 2)), "sphere { center = (0, 1, 3) radius = 2 }");
    check(make_object(packtrace::plane({0, -1, 0}, {0, 3, 4})),
          "plane { point = (0, -1, 0) normal = (0, 3, 4) }");
    check(make_object(ellipsoid()), "ellipsoid { }");
    check(make_object(cylinder()), "cylinder { }");
    check(make_object(clip(cone(), -1, 0)), "cone { z_range = (-1, 0) }");
    check(make_object(clip_and_cap(paraboloid(), 0, 2)),
          "paraboloid { z_range = (0, 2) capped = yes }");
    check(make_object(hyperboloid()), "hyperboloid { }");
    check(make_object(hyperboloid2()), "hyperboloid2 { }");
    check(make_object(saddle()), "saddle { }");
    check(make_object(packtrace::quadric({1, 0, 1, 0, 0, 0, 0, 0, 0, -1})),
          "quadric { coefficients = (1, 0, 1, 0, 0, 0, 0, 0, 0, -1) }");
    check(make_object(packtrace::polygon({{0, 0, 3}, {1, 0, 3}, {0, 1, 3}})),
          "polygon { vertices = (0, 0, 3), (1, 0, 3), (0, 1, 3) }");
    check(translate(rotate(packtrace::scale(make_object(ellipsoid()), {2, 1, -1}), {1, 2, 3}, 40),
                    {1, 2, 3}),
          "ellipsoid { scale = (2, 1, -1) rotate = (1, 2, 3, 40) translate = (1, 2, 3) }");
    check(packtrace::scale(translate(make_object(ellipsoid()), {1, 2, 3}), 2),
          "ellipsoid { translate = (1, 2, 3) scale = 2 }");
    check(make_object(cone(), make_material(Illumination::scratch, "stuff"), "the hat"),
          "material stuff { } cone { name = \"the hat\" material = stuff }");
    CHECK_THROWS_WITH(rotate(make_object(cone()), Vec3(0.0), 40),
                      ContainsSubstring("points nowhere"));
}

TEST_CASE("scenes and materials of an illumination are consistent", "[validate]")
{
    for (int i = 0; i < 5; ++i) {
        const auto illumination = static_cast<Illumination>(i);
        Scene scene = make_scene(illumination);
        scene.objects = {make_object(ellipsoid(), make_material(illumination))};
        CHECK(fault_of(scene) == "accepted");
        CHECK(same(scene, parse(scene_text(scene))));
        scene.objects[0].material = make_material(static_cast<Illumination>((i + 1) % 5));
        CHECK_THAT(fault_of(scene), ContainsSubstring("ellipsoid 1: the material is one of"));
    }
}

}  // namespace packtrace::test
