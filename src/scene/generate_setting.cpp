#include "scene/generate_setting.hpp"

#include "scene/numbers.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace packtrace::generators {

Scene empty_scene(const Vec3& eye, const Vec3& target, const Vec3& up)
{
    Scene scene;
    scene.width = 1024;
    scene.height = 1024;
    scene.camera.position = eye;
    scene.camera.rotation = look_at(eye, target, up);
    scene.camera.fov = 45.0;
    scene.camera.pixel_sample = {0.5, 0.5};
    return scene;
}

std::vector<Light> lamp_at(const Vec3& position)
{
    return {{LightType::ambient, Rgb(0.2), Vec3(0.0)}, {LightType::point, Rgb(0.8), position}};
}

void check_option(const std::string& name, double value, double low, double high)
{
    if (!(value >= low && value <= high))
        throw std::invalid_argument(name + ": " + reader::to_text(value) +
                                    " is out of range; use a number from " + reader::to_text(low) +
                                    " to " + reader::to_text(high));
}

void check_radius(double radius)
{
    if (!(radius > 0.0 && std::isfinite(radius)))
        throw std::invalid_argument("radius: " + reader::to_text(radius) +
                                    " is out of range; use a finite number above 0");
}

Material shiny(const std::string& name, const Rgb& color, double reflective)
{
    check_option("reflective", reflective, 0.0, 1.0);
    Material material;
    material.name = name;
    material.color = color;
    material.model = ScratchMaterial{50.0, reflective};
    return material;
}

void add_sphere(Scene& scene, const Vec3& center, double radius, const Material& material)
{
    Object& object = scene.objects.emplace_back();
    object.name = "sphere " + std::to_string(scene.objects.size());
    object.surface = Sphere{center, radius};
    object.material = material;
}

}  // namespace packtrace::generators
