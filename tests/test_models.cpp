#include "catch.hpp"
#include "lab/stress/placed_quadric.hpp"
#include "reference_scenes.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

// Every illumination model and every surface: packets of doubles against the scalar reference.
namespace packtrace::test {
namespace {

Quadric named(QuadricKind kind)
{
    if (kind != QuadricKind::general)
        return packtrace::quadric(kind);
    return {.kind = kind, .coefficients = {1.0, 1.4, 0.7, 0.3, -0.4, 0.2, 0.1, -0.2, 0.15, -0.9}};
}

Mat4 placed(const Vec3& at, double turn)
{
    Mat4 transform = glm::translate(Mat4(1.0), at);
    transform = glm::rotate(transform, turn, Vec3(0.3, 1.0, 0.2));
    transform = glm::scale(transform, Vec3(0.5, 0.8, -0.6));
    transform[1] += 0.2 * transform[0];  // shear
    return transform;
}

// Two rows of quadrics: clipped and capped, clipped and open, or whole.
void add_quadrics(Scene& scene, const Material& material)
{
    for (int i = 0; i < 16; ++i) {
        Object object;
        Quadric quadric = named(static_cast<QuadricKind>(i % 8));
        if (i % 8 != 0 && i % 8 != 7) {
            quadric.z_range = ZRange{i % 8 == 5 ? 1.1 : -0.9, i % 8 == 5 ? 2.0 : 1.0};
            quadric.capped = i < 8;
        }
        object.surface = quadric;
        object.transform =
            placed({(i % 4 - 1.5) * 1.6, (i / 4 - 1.5) * 1.4, 7.0 + 0.3 * i}, 0.4 * i);
        object.material = material;
        object.name = "quadric " + std::to_string(i);
        scene.objects.push_back(object);
    }
}

void add_lights(Scene& scene)
{
    scene.lights = {ambient(0.2), point_light({2, 3, -1}, 0.6), directional({-1, 4, -4}, 0.3),
                    point_light({-4, 1, 2}, 0.2)};
    scene.lights[1].intensity = {0.6, 0.5, 0.4};
}

Scene base(Illumination illumination, const Material& body, const Material& floor)
{
    Scene scene{
        .width = 93, .height = 71, .background = {0.1, 0.2, 0.3}, .illumination = illumination};
    scene.camera.pixel_sample = {0.4, 0.45};
    scene.camera.viewport = {1.3, 1.0};
    scene.max_depth = 5;
    Object ground = plane({0, -3, 0}, {0.1, 1, 0}, floor);
    ground.material.checker = Checker{{0.2, 0.3, 0.9}, 1.3};
    scene.objects.push_back(ground);
    scene.objects.push_back(sphere({0.4, 0.3, 4}, 0.7, body));
    scene.objects.push_back(sphere({0.4, 0.3, 4.1}, 0.4, body));
    scene.objects.push_back(sphere({-1.2, -0.6, 4.5}, 0.8, body));
    add_lights(scene);
    return scene;
}

template <class Real>
Image<double> packets(const Scene& scene, const std::string& isa)
{
    return convert<double>(render<Real>(scene, {.isa = isa}));
}

Image<double> scalar(const Scene& scene)
{
    return render<double>(scene, {.kernel = Kernel::scalar});
}

void check_scene(const Scene& scene)
{
    const Image<double> truth = scalar(scene);
    for (const IsaInfo& isa : list_isas()) {
        if (!isa.supported)
            continue;
        CAPTURE(isa.name);
        const Comparison doubles = compare(packets<double>(scene, isa.name), truth);
        INFO("worst pixel " << (doubles.worst.empty() ? -1 : doubles.worst[0].x) << ","
                            << (doubles.worst.empty() ? -1 : doubles.worst[0].y));
        CHECK(doubles.max_abs < 1e-9);
        const Comparison floats = compare(packets<float>(scene, isa.name), truth);
        CHECK(static_cast<double>(floats.pixels_off) < 0.01 * static_cast<double>(floats.pixels));
    }
}

}  // namespace

TEST_CASE("packets shade quadrics of every kind as note 001's reference does", "[models]")
{
    Scene scene = base(Illumination::scratch, matte({0.8, 0.5, 0.2}, 0.3), matte(Rgb(0.5), 0.2));
    Material shiny = matte({0.9, 0.8, 0.2}, 0.25);
    shiny.model = ScratchMaterial{50.0, 0.25};
    add_quadrics(scene, shiny);
    check_scene(scene);
}

TEST_CASE("packets render Whitted's model with glass, mirrors and transparent shadows", "[models]")
{
    WhittedMaterial glass{Rgb(0.05), Rgb(0.1), Rgb(0.2), {0.7, 0.8, 0.75}, 40.0, 1.5};
    WhittedMaterial floor{Rgb(0.3), Rgb(0.7), Rgb(0.1), Rgb(0.0), 10.0, 1.0};
    for (const ShadowKind shadows :
         {ShadowKind::none, ShadowKind::opaque, ShadowKind::transparent}) {
        Scene scene =
            base(Illumination::whitted, shaded(glass, {0.9, 0.9, 1.0}), shaded(floor, {1, 1, 0.5}));
        scene.shadows = shadows;
        check_scene(scene);
        add_quadrics(scene, shaded(glass));
        check_scene(scene);
    }
}

TEST_CASE("packets render note 000's sketch, its background and its visible lights", "[models]")
{
    SketchMaterial glass{Rgb(0.0), Rgb(0.0), Rgb(0.3), Rgb(0.7), 30.0, 1.3};
    SketchMaterial floor{Rgb(0.2), Rgb(0.6), Rgb(0.2), Rgb(0.0), 20.0, 1.0};
    Scene scene = base(Illumination::sketch, shaded(glass), shaded(floor, {0.9, 0.4, 0.1}));
    scene.lights.push_back(directional({0.05, 0.1, 1.0}, 0.9));
    scene.max_depth = 4;
    check_scene(scene);
    scene.shadows = ShadowKind::transparent;
    check_scene(scene);
}

TEST_CASE("packets render note 004's shader where object space is similar to world space",
          "[models]")
{
    ShaderMaterial body{{0.2, 0.6, 0.5, 12.0}};
    Scene scene = base(Illumination::shader, shaded(body, {0.8, 0.2, 0.9}), shaded(body));
    scene.objects.push_back(
        {.surface = named(QuadricKind::cylinder),
         .transform = glm::rotate(glm::translate(Mat4(1.0), {1.5, 0.0, 6.0}), 1.0, Vec3(1, 1, 0)),
         .material = shaded(body, {0.1, 0.9, 0.3})});
    check_scene(scene);
}

TEST_CASE("packets render the general equation to either depth limit", "[models]")
{
    GeneralMaterial glass{
        Rgb(0.05), {0.2, 0.1, 0.1}, Rgb(0.4), {0.2, 0.3, 0.1}, {0.6, 0.5, 0.7}, 25.0, 1.7};
    GeneralMaterial floor{Rgb(0.1), Rgb(0.5), Rgb(0.1), Rgb(0.3), Rgb(0.0), 5.0, 1.0};
    for (const DepthLimit limit : {DepthLimit::background, DepthLimit::local}) {
        Scene scene = base(Illumination::general, shaded(glass), shaded(floor));
        scene.objects[0].material.checker.reset();
        scene.depth_limit = limit;
        scene.max_depth = 3;
        scene.shadows = ShadowKind::transparent;
        check_scene(scene);
    }
}

TEST_CASE("lights behind a surface make highlights in the notes that permit it", "[models]")
{
    // A floor seen at a low angle, and a light at the same low angle below it, opposite the eye.
    struct Model {
        Illumination illumination;
        Material material;
        bool highlight;
    };
    Material scratch = matte(Rgb(1));
    scratch.model = ScratchMaterial{4.0, 0.0};
    const std::vector<Model> models{
        {Illumination::scratch, scratch, true},
        {Illumination::sketch, shaded(SketchMaterial{Rgb(0), Rgb(0), Rgb(0.5), Rgb(0), 4, 1}),
         true},
        {Illumination::whitted, shaded(WhittedMaterial{Rgb(0), Rgb(1), Rgb(0.5), Rgb(0), 4, 1}),
         false},
        {Illumination::shader, shaded(ShaderMaterial{{0, 0, 0.5, 4}}), true},
        {Illumination::general,
         shaded(GeneralMaterial{Rgb(0), Rgb(1), Rgb(0.5), Rgb(0), Rgb(0), 4, 1}), false}};
    for (const Model& model : models)
        for (const Light& light : {directional({0, -0.1, 1}, 1), point_light({0, -1.1, 6}, 1)})
            for (const double side : {1.0, -1.0}) {
                Scene scene;
                scene.width = scene.height = 8;
                scene.illumination = model.illumination;
                scene.max_depth = 0;
                scene.camera.position = {0, 0.5, 0};
                scene.camera.rotation = look_at({0, 0.5, 0}, {0, 0, 3}, {0, 1, 0});
                scene.camera.viewport = {0.1, 0.1};
                scene.objects.push_back(plane({0, 0, 0}, {0, 1, 0}, model.material));
                scene.lights = {light};
                scene.lights[0].vector.y *= side;
                CAPTURE(static_cast<int>(model.illumination), static_cast<int>(light.type), side);
                const Image<double> picture = scalar(scene);
                const bool lit = model.highlight || side < 0;
                CHECK(*std::min_element(picture.rgb.begin(), picture.rgb.end()) >= 0.0);
                CHECK((*std::max_element(picture.rgb.begin(), picture.rgb.end()) > 0.05) == lit);
                check_scene(scene);
            }
}

TEST_CASE("a camera inside nested glass starts with the bodies around it", "[models]")
{
    WhittedMaterial outer{Rgb(0.0), Rgb(0.1), Rgb(0.1), Rgb(0.8), 40.0, 1.5};
    WhittedMaterial inner{Rgb(0.0), Rgb(0.1), Rgb(0.1), Rgb(0.8), 40.0, 1.2};
    Scene scene = base(Illumination::whitted, shaded(outer), shaded(outer));
    scene.objects.push_back(sphere({0, 0, 0}, 0.9, shaded(outer)));
    scene.objects.push_back(sphere({0.05, 0, 0.1}, 0.5, shaded(inner)));
    scene.max_depth = 6;
    check_scene(scene);
}

}  // namespace packtrace::test
