#include "export.hpp"

#include <stdexcept>

namespace packtrace::peers {

double checked_ambient(const Scene& scene)
{
    if (scene.illumination != Illumination::scratch)
        throw std::runtime_error("only scenes of illumination = scratch can be exported");
    if (scene.shadows != ShadowKind::opaque)
        throw std::runtime_error("only scenes of shadows = opaque can be exported");
    Rgb sum{0.0};
    for (const Light& light : scene.lights)
        if (light.type == LightType::ambient)
            sum += light.intensity;
    if (sum.x != sum.y || sum.y != sum.z)
        throw std::runtime_error("only white ambient light can be exported");
    return sum.x;
}

void check_object(const Object& object)
{
    if (std::holds_alternative<Quadric>(object.surface) ||
        std::holds_alternative<Polygon>(object.surface) || object.transform != Mat4(1.0) ||
        object.material.checker)
        throw std::runtime_error(object.name +
                                 " can't be exported, only plain spheres and planes can");
}

}  // namespace packtrace::peers
