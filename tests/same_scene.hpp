#pragma once

#include "scene/object_names.hpp"
#include <packtrace/scene.hpp>

// Whether all numbers of two scenes are the same.
namespace packtrace::test {

inline bool same(const Sphere& a, const Sphere& b)
{
    return a.center == b.center && a.radius == b.radius;
}

inline bool same(const Plane& a, const Plane& b)
{
    return a.point == b.point && a.normal == b.normal;
}

inline bool same(const Quadric& a, const Quadric& b)
{
    return a.kind == b.kind && a.coefficients == b.coefficients && a.capped == b.capped &&
           a.z_range.has_value() == b.z_range.has_value() &&
           (!a.z_range || (a.z_range->low == b.z_range->low && a.z_range->high == b.z_range->high));
}

inline bool same(const Polygon& a, const Polygon& b)
{
    return a.contours == b.contours;
}

inline bool same(const ScratchMaterial& a, const ScratchMaterial& b)
{
    return a.specular == b.specular && a.reflective == b.reflective;
}

inline bool same(const SketchMaterial& a, const SketchMaterial& b)
{
    return a.ambient == b.ambient && a.diffuse == b.diffuse && a.specular == b.specular &&
           a.refractive == b.refractive && a.shininess == b.shininess && a.ior == b.ior;
}

inline bool same(const WhittedMaterial& a, const WhittedMaterial& b)
{
    return a.ambient == b.ambient && a.diffuse == b.diffuse && a.specular == b.specular &&
           a.transmissive == b.transmissive && a.shininess == b.shininess && a.ior == b.ior;
}

inline bool same(const ShaderMaterial& a, const ShaderMaterial& b)
{
    return a.reflectance == b.reflectance;
}

inline bool same(const GeneralMaterial& a, const GeneralMaterial& b)
{
    return a.ambient == b.ambient && a.diffuse == b.diffuse && a.highlight == b.highlight &&
           a.reflect == b.reflect && a.transmit == b.transmit && a.shininess == b.shininess &&
           a.ior == b.ior;
}

template <class... Kinds>
bool same(const std::variant<Kinds...>& a, const std::variant<Kinds...>& b)
{
    return a.index() == b.index() && std::visit(
                                         [&](const auto& one) {
                                             using Kind = std::decay_t<decltype(one)>;
                                             return same(one, std::get<Kind>(b));
                                         },
                                         a);
}

inline bool same(const Material& a, const Material& b)
{
    return a.name == b.name && a.color == b.color && same(a.model, b.model) &&
           a.checker.has_value() == b.checker.has_value() &&
           (!a.checker ||
            (a.checker->other == b.checker->other && a.checker->size == b.checker->size));
}

/// The axes of a plane matter only if it has a checker.
inline bool same_axes(const Object& a, const Object& b)
{
    const auto* const one = std::get_if<Plane>(&a.surface);
    const auto* const other = std::get_if<Plane>(&b.surface);
    return !a.material.checker || one == nullptr || (one->u == other->u && one->v == other->v);
}

inline bool same(const Camera& a, const Camera& b)
{
    return a.position == b.position && a.rotation == b.rotation && a.viewport == b.viewport &&
           a.distance == b.distance && a.fov == b.fov && a.pixel_sample == b.pixel_sample;
}

inline bool same(const Light& a, const Light& b)
{
    return a.type == b.type && a.intensity == b.intensity && a.vector == b.vector &&
           a.casts_shadow == b.casts_shadow;
}

inline bool same(const Animation& a, const Animation& b)
{
    const auto same_key = [](const CameraKey& one, const CameraKey& other) {
        return one.frame == other.frame && one.position == other.position &&
               one.look_at == other.look_at && one.up == other.up;
    };
    return a.frames == b.frames && a.orbit.has_value() == b.orbit.has_value() &&
           (!a.orbit || (a.orbit->center == b.orbit->center && a.orbit->axis == b.orbit->axis &&
                         a.orbit->degrees == b.orbit->degrees)) &&
           std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(), same_key);
}

/// Unnamed objects of `a` correspond to objects of `b` with generated names.
inline bool same_objects(const Scene& a, const Scene& b)
{
    language::DefaultNames names;
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        const Object& one = a.objects[i];
        const Object& other = b.objects[i];
        const bool same_name =
            names.takes(one) ? other.name == language::label_of(a, i) : other.name == one.name;
        if (!same_name || !same(one.surface, other.surface) || one.transform != other.transform ||
            !same(one.material, other.material) || one.casts_shadow != other.casts_shadow ||
            !same_axes(one, other))
            return false;
    }
    return true;
}

inline bool same(const Scene& a, const Scene& b)
{
    const auto same_light = [](const Light& one, const Light& other) { return same(one, other); };
    return a.width == b.width && a.height == b.height && a.background == b.background &&
           a.illumination == b.illumination && a.max_depth == b.max_depth &&
           a.min_weight == b.min_weight && a.depth_limit == b.depth_limit &&
           a.shadows == b.shadows && same(a.camera, b.camera) &&
           a.objects.size() == b.objects.size() && same_objects(a, b) &&
           std::equal(a.lights.begin(), a.lights.end(), b.lights.begin(), b.lights.end(),
                      same_light) &&
           a.animation.has_value() == b.animation.has_value() &&
           (!a.animation || same(*a.animation, *b.animation));
}

}  // namespace packtrace::test
