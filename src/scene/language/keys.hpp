#pragma once

#include "scene/language/rows.hpp"
#include "scene/language/words.hpp"

// The scene language's keys.
namespace packtrace::language {

/// The keys of the camera's block. Its pose is either a rotation or look_at and up.
struct CameraKeys {
    Vec3 position{0.0};
    std::optional<Vec3> look_at;
    Vec3 up{0.0, 1.0, 0.0};
    std::optional<Mat3> rotation;
    std::optional<double> fov;
};

/// The keys of a camera, with its pose as a rotation.
[[nodiscard]] inline CameraKeys keys_of_camera(const Camera& camera)
{
    return {
        .position = camera.position, .look_at = {}, .rotation = camera.rotation, .fov = camera.fov};
}

/// The keys of every object, besides those of its surface and its material.
struct ObjectKeys {
    std::optional<std::string> name;
    std::optional<std::string> material;
    std::optional<CheckerValue> checker;
    bool casts_shadow = true;
};

inline constexpr std::string_view unit_sphere = "(1, 1, 1, 0, 0, 0, 0, 0, 0, -1)";

/// Access to a member of the camera, for keys of the scene itself.
template <class Member>
auto of_camera(Member Camera::*member)
{
    return [member](auto& scene) -> auto&
    {
        return scene.camera.*member;
    };
}

inline Row<Scene> image_size_row()
{
    const Type<Vec2> sides = size({.low = 1.0, .high = 65536.0, .whole = true, .unit = " pixels"});
    return {.key = "image_size",
            .meaning = "pixels",
            .takes = sides.takes,
            .read =
                [sides](const Field& field, Scene& scene) {
                    const Vec2 read = sides.read(field);
                    scene.width = static_cast<int>(read.x);
                    scene.height = static_cast<int>(read.y);
                },
            .write =
                [sides](std::string& out, const Scene& scene) {
                    sides.write(out, {scene.width, scene.height});
                },
            .is_set = [](const Scene&) { return true; },
            .check =
                [sides](const Scene& scene) {
                    return sides.check("image_size", {scene.width, scene.height});
                }};
}

/// The keys of note 000 and of note 002. They differ only in the name of the transmitted share.
template <class Model>
Rows<Model> note_rows(std::string_view transmitted, Rgb Model::*member)
{
    return {
        row("ambient", factor(), &Model::ambient, "Ka, times the colour"),
        row("diffuse", factor(), &Model::diffuse, "Kd, times the colour"),
        row("specular", factor(), &Model::specular, "Ks, mirror and highlight, white"),
        row(transmitted, factor(), member, "the share that goes through, white"),
        row("shininess", number(any_exponent), &Model::shininess, "the highlight's exponent"),
        row("ior", number(any_ior), &Model::ior, "index of refraction"),
    };
}

template <>
inline const Rows<Scene> rows<Scene>{
    image_size_row(),
    row<Scene>("viewport_size", size(any_length), of_camera(&Camera::viewport),
               "the window the canvas is laid over, see Camera; not used with `fov`"),
    row<Scene>("projection_plane_d", number(any_length), of_camera(&Camera::distance),
               "the window's distance from the eye"),
    row("background", color(), &Scene::background, "what a ray gets that hits nothing"),
    row("illumination", choice<Illumination>(), &Scene::illumination, "the model, see Materials"),
    row("max_depth", whole_number(0, 64), &Scene::max_depth,
        "reflections and refractions after the camera ray"),
    row("min_weight", number(share), &Scene::min_weight,
        "a mirrored or refracted ray is not traced where its colour would be multiplied by less in "
        "every channel on its way to the eye (what is less by at most 2^-16 of it counts as "
        "equal); `render` says how far off that can make a pixel"),
    row("depth_limit", choice<DepthLimit>(), &Scene::depth_limit,
        "`general` only: what a ray adds that would have to go deeper")
        .only_if([](const Scene& scene) { return scene.illumination == Illumination::general; },
                 "'depth_limit' belongs to illumination = general, the other models "
                 "have a rule of their own; remove it",
                 [](const Scene& scene) { return scene.depth_limit == DepthLimit::local; }),
    row("shadows", choice<ShadowKind>(), &Scene::shadows,
        "with `none` they are not looked for, with `opaque` any occluder stops the "
        "light, with `transparent` each lets its transmitted share through (note 002)"),
    row<Scene>("pixel_sample", pair(share), of_camera(&Camera::pixel_sample),
               "where in a pixel its sample lies, from its left and top edge"),
};

template <>
inline const Rows<CameraKeys> rows<CameraKeys>{
    row("position", point(), &CameraKeys::position, "the eye"),
    row("look_at", point(), &CameraKeys::look_at,
        "turns the view to a point; other than `position`, and not straight along "
        "`up`"),
    row("up", direction(), &CameraKeys::up, "only with `look_at`: the picture's upper side")
        .only_if([](const CameraKeys& camera) { return camera.look_at.has_value(); },
                 "'up' has no effect without 'look_at'; add look_at or remove it"),
    row("rotation", rotation(), &CameraKeys::rotation,
        "instead of `look_at`: note 001's `camera.rotation`")
        .only_if([](const CameraKeys& camera) { return !camera.look_at.has_value(); },
                 "'rotation' and 'look_at' both turn the camera; remove one of them"),
    row("fov",
        number({.low = 0.0,
                .high = 180.0,
                .smallest = 1e-9,
                .open = true,
                .noun = "angle",
                .unit = " degrees"}),
        &CameraKeys::fov, "full vertical angle of view; the window then takes the picture's shape"),
};

template <>
inline const Rows<Mat4> rows<Mat4> = transform_rows();

template <>
inline const Rows<Sphere> rows<Sphere>{
    row("center", point(), &Sphere::center, "").needed("(0, 0, 3)"),
    row("radius", number(any_length), &Sphere::radius, "").needed("1"),
};

template <>
inline const Rows<Plane> rows<Plane>{
    row("point", point(), &Plane::point, "any of its points").needed("(0, -1, 0)"),
    row("normal", unit_direction(), &Plane::normal, "").needed("(0, 1, 0)"),
};

/// Whether the coefficients of a quadric are those of its kind.
[[nodiscard]] inline bool has_own_coefficients(const Quadric& quadric)
{
    const QuadricKindInfo* const kind = find_quadric_kind(quadric.kind);
    return kind == nullptr ? quadric.kind == QuadricKind::general
                           : quadric.coefficients == kind->coefficients;
}

template <>
inline const Rows<Quadric> rows<Quadric>{
    row("coefficients", numbers<10>("`(A, B, C, D, E, F, G, H, I, J)`", unit_sphere),
        &Quadric::coefficients, "in the order of the equation")
        .needed(unit_sphere)
        .only_if([](const Quadric& quadric) { return quadric.kind == QuadricKind::general; },
                 "the coefficients are not those of the quadric's kind; fill them in, as "
                 "ellipsoid(), cone() and so on do, or make the kind general",
                 has_own_coefficients),
    row("z_range", z_range(), &Quadric::z_range,
        "keeps the part between two heights in its own space, before the transform"),
    row("capped", choice<bool>(), &Quadric::capped,
        "needs a `z_range`: closes it there with flat pieces where the left side of "
        "the equation is at "
        "most that of the right")
        .only_if(
            [](const Quadric& quadric) { return !quadric.capped || quadric.z_range.has_value(); },
            "'capped' closes the ends of a z_range, and there is none; add for "
            "example z_range = (-1, 1) or remove it",
            [](const Quadric&) { return false; }),
};

/// Each occurrence of this key adds a contour.
inline Row<Polygon> vertices_row()
{
    const Type<std::vector<Vec3>> contour = points();
    return {
        .key = "vertices",
        .meaning =
            "the corners in turn, all in one plane; once more for each further contour, "
            "such as a hole",
        .takes = contour.takes,
        .read = [contour](const Field& field,
                          Polygon& polygon) { polygon.contours.push_back(contour.read(field)); },
        .write =
            [contour](std::string& out, const Polygon& polygon) {
                for (std::size_t i = 0; i < polygon.contours.size(); ++i) {
                    out += i == 0 ? "" : " vertices=";
                    contour.write(out, polygon.contours[i]);
                }
            },
        .is_set = [](const Polygon& polygon) { return !polygon.contours.empty(); },
        .check = [contour](const Polygon& polygon) -> Fault {
            for (const std::vector<Vec3>& points : polygon.contours)
                if (Fault fault = contour.check("vertices", points))
                    return fault;
            return std::nullopt;
        },
        .example = "(0, 0, 3), (1, 0, 3), (0, 1, 3)",
        .repeatable = true};
}

template <>
inline const Rows<Polygon> rows<Polygon>{vertices_row()};

template <>
inline const Rows<ObjectKeys> rows<ObjectKeys>{
    row("name", name(), &ObjectKeys::name,
        "what reports call it, its own; without it `sphere 1`, `sphere 2`, `cone "
        "1` ..., counted by kind"),
    row("material", name(), &ObjectKeys::material,
        "a named material, see below, instead of the keys of one"),
    row("checker", checker(), &ObjectKeys::checker, "planes only, see below"),
    row("casts_shadow", choice<bool>(), &ObjectKeys::casts_shadow,
        "with `no` it stops no light, not for itself either"),
};

template <>
inline const Rows<Material> rows<Material>{
    row("color", color(), &Material::color, "tints what comes from its own surface")
        .only_if([](const Material& material) { return !material.checker.has_value(); },
                 "'checker' gives both colours; remove 'color'"),
};

template <>
inline const Rows<ScratchMaterial> rows<ScratchMaterial>{
    row("specular",
        number({.low = 0.0,
                .largest = largest_exponent,
                .noun = "exponent",
                .except = "-1 for no highlight"}),
        &ScratchMaterial::specular, "the highlight's exponent; the highlight has the colour too"),
    row("reflective", number(share), &ScratchMaterial::reflective,
        "share of the mirrored light, white; the rest is the object's own"),
};

template <>
inline const Rows<SketchMaterial> rows<SketchMaterial>{
    note_rows("refractive", &SketchMaterial::refractive)};

template <>
inline const Rows<WhittedMaterial> rows<WhittedMaterial>{
    note_rows("transmissive", &WhittedMaterial::transmissive)};

template <>
inline const Rows<ShaderMaterial> rows<ShaderMaterial>{
    row("reflectance",
        numbers<4>("`(r0, r1, r2, r3)`, each 0 or more", "(0.2, 0.6, 0.2, 16)", any_exponent),
        &ShaderMaterial::reflectance, "f = r0 + r1 Id + r2 Is^r3, times the colour and each light"),
};

template <>
inline const Rows<GeneralMaterial> rows<GeneralMaterial>{
    row("ambient", factor(), &GeneralMaterial::ambient, "absolute: there is no `color`"),
    row("diffuse", factor(), &GeneralMaterial::diffuse, ""),
    row("highlight", factor(), &GeneralMaterial::highlight, ""),
    row("reflect", factor(), &GeneralMaterial::reflect, "share of the mirrored light"),
    row("transmit", factor(), &GeneralMaterial::transmit, "the share that goes through"),
    row("shininess", number(any_exponent), &GeneralMaterial::shininess, "the highlight's exponent"),
    row("ior", number(any_ior), &GeneralMaterial::ior, "index of refraction"),
};

template <>
inline const Rows<Light> rows<Light>{
    row("type", choice<LightType>(), &Light::type, "").needed("point"),
    row("intensity", factor(), &Light::intensity,
        "0.6 is 0.6 of full, it does not fall off with the distance")
        .needed("0.6"),
    row("position", point(), &Light::vector, "`point` only")
        .needed("(2, 1, 0)")
        .only_if([](const Light& light) { return light.type == LightType::point; },
                 "only a point light has a position; remove it",
                 [](const Light& light) {
                     return light.type != LightType::ambient || light.vector == Vec3(0.0);
                 }),
    row("direction", direction(), &Light::vector,
        "`directional` only: from the scene *towards* the light")
        .needed("(1, 4, 4)")
        .only_if([](const Light& light) { return light.type == LightType::directional; },
                 "only a directional light has a direction; remove it"),
    row("casts_shadow", choice<bool>(), &Light::casts_shadow,
        "with `no` it reaches all that turns to it, whatever is between; not for "
        "`ambient`")
        .only_if([](const Light& light) { return light.type != LightType::ambient; },
                 "an ambient light casts no shadow anyway; remove it",
                 [](const Light& light) { return light.casts_shadow; }),
};

template <>
inline const Rows<Animation> rows<Animation>{
    row("frames", whole_number(1, 1'000'000), &Animation::frames, "pictures, numbered from 0")
        .needed("120"),
};

template <>
inline const Rows<Orbit> rows<Orbit>{
    row("center", point(), &Orbit::center, "what the camera looks at").needed("(0, 0, 3)"),
    row("axis", direction(), &Orbit::axis, "passes through the center, the camera is not on it"),
    row("degrees", number(any_number), &Orbit::degrees,
        "swept over the whole animation, with the sign of `rotate`"),
};

template <>
inline const Rows<CameraKey> rows<CameraKey>{
    row("frame", whole_number(0, 999'999), &CameraKey::frame, "below `frames`").needed("0"),
    row("position", point(), &CameraKey::position, "the eye").needed("(0, 0, 0)"),
    row("look_at", point(), &CameraKey::look_at, "what it looks at").needed("(0, 0, 3)"),
    row("up", direction(), &CameraKey::up, "the picture's upper side"),
};

/// The scene of an empty file, under this illumination.
[[nodiscard]] inline Scene default_scene(Illumination illumination)
{
    Scene scene{.illumination = illumination};
    // Note 001 samples its own integer canvas points.
    if (illumination != Illumination::scratch)
        scene.camera.pixel_sample = {0.5, 0.5};
    // Note 000 continues while depth <= 5, where the camera ray has depth 1.
    if (illumination == Illumination::sketch)
        scene.max_depth = 4;
    return scene;
}

[[nodiscard]] inline Material default_material(Illumination illumination)
{
    Material material;
    switch (illumination) {
        case Illumination::scratch:
            material.model = ScratchMaterial{};
            break;
        case Illumination::sketch:
            material.model = SketchMaterial{};
            break;
        case Illumination::whitted:
            material.model = WhittedMaterial{};
            break;
        case Illumination::shader:
            material.model = ShaderMaterial{};
            break;
        case Illumination::general:
            material.model = GeneralMaterial{};
            break;
    }
    return material;
}

/// Calls `visit` with each part of a material that has rows, in the order of the keys.
template <class SomeMaterial, class Visit>
void visit_parts(SomeMaterial& material, const Visit& visit)
{
    // The general model has no colour.
    if (!std::holds_alternative<GeneralMaterial>(material.model))
        visit(material);
    std::visit(visit, material.model);
}

}  // namespace packtrace::language
