// A scene animated in code: a glass ball bounces on a checkered floor, an egg spins beside it, and
// the light swings above both. Writes animation_00.png and the frames after it; the argument is
// their number, 24 if none is given. ffmpeg -i animation_%02d.png animation.mp4 makes a film of
// them.
#include <packtrace/build.hpp>
#include <packtrace/image_io.hpp>
#include <packtrace/render.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <variant>

namespace {

using namespace packtrace;

constexpr double pi = 3.14159265358979323846;

Material glass()
{
    Material material = make_material(Illumination::whitted, "glass");
    auto& model = std::get<WhittedMaterial>(material.model);
    model.specular = Rgb(0.1);
    model.transmissive = Rgb(0.85);
    model.ior = 1.5;
    model.shininess = 200;
    return material;
}

Material painted(const Rgb& color)
{
    Material material = make_material(Illumination::whitted);
    material.color = color;
    auto& model = std::get<WhittedMaterial>(material.model);
    model.ambient = Rgb(0.25);
    model.diffuse = Rgb(0.7);
    return material;
}

Object floor_object()
{
    Object object = make_object(plane({0, -1, 0}, {0, 1, 0}), painted({0.9, 0.9, 0.8}), "floor");
    object.material.checker = Checker{{0.2, 0.3, 0.2}, 0.5};
    return object;
}

/// The scene at a time from 0 to 1, after which it is as at the start.
Scene scene_at(double time)
{
    Scene scene = make_scene(Illumination::whitted);
    scene.width = 320;
    scene.height = 240;
    scene.shadows = ShadowKind::transparent;
    scene.background = Rgb(0.5, 0.7, 0.9);
    scene.camera.fov = 50;
    // Thrown up at the start, down again at the end.
    const double height = 4.0 * time * (1.0 - time);
    const Object ball = make_object(sphere({0, 0, 0}, 0.7), glass(), "ball");
    const Object egg = make_object(ellipsoid(), painted({0.9, 0.5, 0.2}), "egg");
    scene.objects = {
        floor_object(), translate(ball, {-0.6, height - 0.3, 4}),
        translate(rotate(scale(egg, {0.4, 0.7, 0.4}), {0, 0, 1}, 360.0 * time), {1.0, 0, 5})};
    scene.lights = {ambient_light(Rgb(0.4)),
                    point_light({3.0 * std::sin(2.0 * pi * time), 5, 1}, Rgb(0.9))};
    return scene;
}

}  // namespace

int main(int argc, char** argv)
{
    const int frames = argc > 1 ? std::atoi(argv[1]) : 24;
    for (int frame = 0; frame < frames; ++frame) {
        char name[32];
        std::snprintf(name, sizeof name, "animation_%02d.png", frame);
        write_image(name, render<float>(scene_at(static_cast<double>(frame) / frames)));
    }
}
