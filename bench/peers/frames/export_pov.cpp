#include "export.hpp"
#include "text.hpp"

#include <glm/geometric.hpp>

#include <map>
#include <vector>

namespace packtrace::peers {
namespace {

/// In scenes of up to this many objects, each object has its own lights.
constexpr std::size_t few = 16;

std::string vector(const Vec3& v)
{
    return "<" + numbers(v, ",") + ">";
}

std::string camera(const Scene& scene)
{
    const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
    // The basis is for one pixel, POV-Ray's vectors are for the whole picture.
    return "camera { perspective location " + vector(basis.origin) + " right " +
           vector(basis.right * static_cast<double>(scene.width)) + " up " +
           vector(basis.up * static_cast<double>(scene.height)) + " direction " +
           vector(basis.forward) + " }\n";
}

/// All lights but the ambient ones, multiplied by an object's colour.
std::string lights(const Scene& scene, const Rgb& color)
{
    // Far enough for the light to be parallel in all scenes here.
    constexpr double far = 1e7;
    std::string text;
    for (const Light& light : scene.lights) {
        const std::string tinted = " color rgb " + vector(light.intensity * color);
        if (light.type == LightType::point)
            text += "light_source { " + vector(light.vector) + tinted + " }\n";
        if (light.type == LightType::directional)
            text += "light_source { " + vector(far * glm::normalize(light.vector)) + tinted +
                    " parallel point_at <0,0,0> }\n";
    }
    return text;
}

std::string surface(const Surface& surface)
{
    if (const auto* sphere = std::get_if<Sphere>(&surface))
        return "sphere { " + vector(sphere->center) + ", " + number(sphere->radius);
    const auto& plane = std::get<Plane>(surface);
    return "plane { " + vector(plane.normal) + ", " + number(glm::dot(plane.normal, plane.point));
}

/// As in note 001: local light times 1 - r, reflected light times r.
std::string texture(const Material& material, double ambient, const Rgb& pigment)
{
    const auto& scratch = std::get<ScratchMaterial>(material.model);
    const double local = 1.0 - scratch.reflective;
    std::string text = "texture { pigment { color rgb " + vector(pigment) + " } finish { ";
    // With a white pigment the colour is in the lights, so ambient light must have it, too.
    text += "ambient rgb " + vector(ambient * local * material.color / pigment);
    text += " diffuse " + number(local);
    if (scratch.specular >= 0.0)
        text += " phong " + number(local) + " phong_size " + number(scratch.specular);
    if (scratch.reflective > 0.0)
        text += " reflection { " + number(scratch.reflective) + " }";
    return text + " } }";
}

std::string objects_with_own_lights(const Scene& scene, double ambient)
{
    std::string text;
    for (const Object& object : scene.objects) {
        check_object(object);
        text += "light_group {\n" + lights(scene, object.material.color) + surface(object.surface) +
                " " + texture(object.material, ambient, Rgb(1.0)) + " }\nglobal_lights off }\n";
    }
    return text;
}

std::string many_objects(const Scene& scene, double ambient)
{
    std::string text = lights(scene, Rgb(1.0));
    std::map<std::string, std::string> names;
    for (const Object& object : scene.objects) {
        check_object(object);
        const Rgb color = glm::max(object.material.color, Rgb(1e-6));
        const std::string look = texture(object.material, ambient, color);
        const auto [name, added] = names.emplace(look, "Look" + std::to_string(names.size()));
        if (added)
            text += "#declare " + name->second + " = " + look + "\n";
        text += surface(object.surface) + " texture { " + name->second + " } }\n";
    }
    return text;
}

}  // namespace

std::string pov_scene(const Scene& scene)
{
    const double ambient = checked_ambient(scene);
    return "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level " +
           std::to_string(scene.max_depth + 1) + " adc_bailout " + number(scene.min_weight) +
           " }\nbackground { color rgb " + vector(scene.background) + " }\n" + camera(scene) +
           (scene.objects.size() <= few ? objects_with_own_lights(scene, ambient)
                                        : many_objects(scene, ambient));
}

}  // namespace packtrace::peers
