#include "export.hpp"
#include "text.hpp"

#include <glm/geometric.hpp>

#include <map>

namespace packtrace::peers {
namespace {

std::string vector(const Vec3& v)
{
    return numbers(v, " ");
}

std::string camera(const Scene& scene)
{
    const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
    // Tachyon's picture has the height 1 / zoom at distance 1.
    const double zoom =
        glm::length(basis.forward) / (glm::length(basis.up) * static_cast<double>(scene.height));
    return "CAMERA\n  ZOOM " + number(zoom) + "\n  ASPECTRATIO 1\n  ANTIALIASING 0\n  RAYDEPTH " +
           std::to_string(scene.max_depth + 1) + "\n  CENTER " + vector(basis.origin) +
           "\n  VIEWDIR " + vector(glm::normalize(basis.forward)) + "\n  UPDIR " +
           vector(glm::normalize(basis.up)) + "\nEND_CAMERA\n";
}

std::string lights(const Scene& scene)
{
    std::string text;
    for (const Light& light : scene.lights) {
        if (light.type == LightType::point)
            text += "LIGHT CENTER " + vector(light.vector) + " RAD 0 COLOR " +
                    vector(light.intensity) + "\n";
        if (light.type == LightType::directional)
            text += "DIRECTIONAL_LIGHT DIRECTION " + vector(-glm::normalize(light.vector)) +
                    " COLOR " + vector(light.intensity) + "\n";
    }
    return text;
}

/// As in note 001: local light times 1 - r, reflected light times r, highlights in the object's
/// colour.
std::string texture(const Material& material, double ambient)
{
    const auto& scratch = std::get<ScratchMaterial>(material.model);
    const double local = 1.0 - scratch.reflective;
    const bool shines = scratch.specular >= 0.0;
    return "AMBIENT " + number(ambient * local) + " DIFFUSE " + number(local) + " SPECULAR " +
           number(scratch.reflective) + " OPACITY 1 PHONG METAL " + number(shines ? local : 0.0) +
           " PHONG_SIZE " + number(shines ? scratch.specular : 1.0) + " COLOR " +
           vector(material.color) + " TEXFUNC 0\n";
}

std::string surface(const Surface& surface)
{
    if (const auto* sphere = std::get_if<Sphere>(&surface))
        return "SPHERE CENTER " + vector(sphere->center) + " RAD " + number(sphere->radius);
    const auto& plane = std::get<Plane>(surface);
    return "PLANE CENTER " + vector(plane.point) + " NORMAL " + vector(plane.normal);
}

std::string objects(const Scene& scene, double ambient)
{
    std::string text;
    std::map<std::string, std::string> names;
    for (const Object& object : scene.objects) {
        check_object(object);
        const std::string look = texture(object.material, ambient);
        const auto [name, added] = names.emplace(look, "look" + std::to_string(names.size()));
        if (added)
            text += "TEXDEF " + name->second + " " + look;
        text += surface(object.surface) + " " + name->second + "\n";
    }
    return text;
}

}  // namespace

std::string tachyon_scene(const Scene& scene)
{
    const double ambient = checked_ambient(scene);
    return "BEGIN_SCENE\nRESOLUTION " + std::to_string(scene.width) + " " +
           std::to_string(scene.height) + "\n" + camera(scene) + "BACKGROUND " +
           vector(scene.background) + "\n" + lights(scene) + objects(scene, ambient) +
           "END_SCENE\n";
}

}  // namespace packtrace::peers
