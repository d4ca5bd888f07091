#pragma once

#include "random_scenes.hpp"

#include <array>
#include <initializer_list>
#include <limits>
#include <span>
#include <vector>

// Ways to break a scene, each with exactly one fault.
namespace packtrace::test {

struct Break {
    const char* name;
    bool has_text;  ///< the scene language can express the fault, and the reader refuses it
    void (*apply)(RandomScene&);
};

/// Replaces the last object by one with this surface and default values.
inline Object& last_as(RandomScene& random, const Surface& surface)
{
    Object& object = random.scene.objects.back();
    object = make_object(surface, make_material(random.scene.illumination));
    return object;
}

inline void last_as_ball(RandomScene& random, const Vec3& center, double radius)
{
    last_as(random, packtrace::sphere(center, radius));
}

/// Gives all objects a material of this model.
template <class Model>
void shade_all(RandomScene& random, Illumination illumination, const Model& model)
{
    random.scene.illumination = illumination;
    random.scene.depth_limit = DepthLimit::local;
    for (Object& object : random.scene.objects) {
        object.material = make_material(illumination, random.chance(0.5) ? "stuff" : "");
        object.material.model = model;
    }
}

/// A quadric with a kind and default values.
inline Quadric bare(QuadricKind kind)
{
    return {.kind = kind};
}

/// A number that every key refuses.
inline double unreal(RandomScene& random)
{
    constexpr double inf = std::numeric_limits<double>::infinity();
    const double numbers[] = {std::numeric_limits<double>::quiet_NaN(), inf, -inf};
    return numbers[random.below(3)];
}

inline constexpr Break surface_breaks[] = {
    {"radius", true,
     [](auto& r) {
         last_as_ball(r, {0, 0, 3}, -r.below(3));
     }},
    {"unreal radius", true,
     [](auto& r) {
         last_as_ball(r, {0, 0, 3}, unreal(r));
     }},
    {"huge radius", true,
     [](auto& r) {
         last_as_ball(r, {0, 0, 3}, 1e20);
     }},
    {"tiny radius", true,
     [](auto& r) {
         last_as_ball(r, {0, 0, 3}, 1e-20);
     }},
    {"unreal center", true,
     [](auto& r) {
         last_as_ball(r, {0, unreal(r), 3}, 1);
     }},
    {"far center", true,
     [](auto& r) {
         last_as_ball(r, {0, -1e20, 3}, 1);
     }},
    {"far by double", true,
     [](auto& r) {
         last_as_ball(r, {0, 0, 1e300}, 1);
     }},
    {"no normal", true, [](auto& r) { last_as(r, Plane{.normal = Vec3(0.0)}); }},
    {"long normal", false, [](auto& r) { last_as(r, Plane{.normal = Vec3(0, 2, 0)}); }},
    {"unreal normal", true, [](auto& r) { last_as(r, Plane{.normal = Vec3(unreal(r), 1, 0)}); }},
    {"coefficients of no kind", false,
     [](auto& r) { last_as(r, bare(static_cast<QuadricKind>(r.below(7)))); }},
    {"coefficients of another kind", false,
     [](auto& r) {
         Quadric quadric = cone();
         quadric.kind = QuadricKind::saddle;
         last_as(r, quadric);
     }},
    {"no such kind", false, [](auto& r) { last_as(r, bare(static_cast<QuadricKind>(77))); }},
    {"no surface", true,
     [](auto& r) {
         last_as(r, packtrace::quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, 1}));
     }},
    {"a point only", true,
     [](auto& r) {
         last_as(r, packtrace::quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, 0}));
     }},
    {"no coefficients", true,
     [](auto& r) { last_as(r, packtrace::quadric(std::array<double, 10>{})); }},
    {"unreal coefficient", true,
     [](auto& r) {
         Quadric quadric = packtrace::quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, -1});
         quadric.coefficients[static_cast<std::size_t>(r.below(10))] = unreal(r);
         last_as(r, quadric);
     }},
    {"center far away", true,
     [](auto& r) {
         last_as(r, packtrace::quadric({1e-9, 1, 1, 0, 0, 0, 1e9, 0, 0, -1}));
     }},
    {"empty z_range", true, [](auto& r) { last_as(r, clip(cone(), 1, 1 - r.below(2))); }},
    {"unreal z_range", true, [](auto& r) { last_as(r, clip(cylinder(), unreal(r), 1)); }},
    {"cap of nothing", false,
     [](auto& r) {
         Quadric quadric = ellipsoid();
         quadric.capped = true;
         last_as(r, quadric);
     }},
    {"two corners", true,
     [](auto& r) {
         last_as(r, packtrace::polygon({{0, 0, 3}, {1, 0, 3}}));
     }},
    {"no contour", false, [](auto& r) { last_as(r, Polygon{}); }},
    {"no area", true,
     [](auto& r) {
         last_as(r, packtrace::polygon({{0, 0, 3}, {1, 0, 3}, {2, 0, 3}}));
     }},
    {"not flat", true,
     [](auto& r) {
         last_as(r, packtrace::polygon({{0, 0, 3}, {2, 0, 3}, {2, 2, 3}, {0, 2, 4}}));
     }},
    {"unreal corner", true,
     [](auto& r) {
         last_as(r, packtrace::polygon({{0, 0, 3}, {1, unreal(r), 3}, {2, 1, 3}}));
     }},
};

inline constexpr Break transform_breaks[] = {
    {"flat", true,
     [](auto& r) {
         r.scene.objects[0] = packtrace::scale(r.scene.objects[0], {1, 0, 1});
     }},
    {"unreal transform", true,
     [](auto& r) { r.scene.objects[0].transform[r.below(3)][r.below(3)] = unreal(r); }},
    {"far away", true,
     [](auto& r) {
         r.scene.objects[0] = translate(r.scene.objects[0], {0, 1e16, 0});
     }},
    {"too small", true,
     [](auto& r) {
         r.scene.objects[0].transform = Mat4(1.0);
         r.scene.objects[0] = packtrace::scale(r.scene.objects[0], 1e-17);
     }},
    {"far together", true,
     [](auto& r) {
         Object& object = last_as(r, packtrace::sphere({0, 9e12, 0}, 1));
         object = translate(object, {0, 9e12, 0});
     }},
    {"large together", true,
     [](auto& r) {
         Object& object = last_as(r, packtrace::sphere({0, 0, 0}, 1e10));
         object = packtrace::scale(object, 1e10);
     }},
    {"not affine", false, [](auto& r) { r.scene.objects[0].transform[1][3] = 0.5; }},
};

inline constexpr Break material_breaks[] = {
    {"another model", false,
     [](auto& r) {
         const auto other = (static_cast<int>(r.scene.illumination) + 1 + r.below(4)) % 5;
         r.scene.objects.back().material.model =
             make_material(static_cast<Illumination>(other)).model;
     }},
    {"reflective", true,
     [](auto& r) {
         shade_all(r, Illumination::scratch, ScratchMaterial{-1, 1.5});
     }},
    {"specular", true,
     [](auto& r) {
         shade_all(r, Illumination::scratch, ScratchMaterial{-0.5, 0});
     }},
    {"dark factor", true,
     [](auto& r) {
         shade_all(r, Illumination::sketch, SketchMaterial{.diffuse = Rgb(0.5, -1, 0)});
     }},
    {"unreal factor", true,
     [](auto& r) {
         shade_all(r, Illumination::whitted, WhittedMaterial{.ambient = Rgb(unreal(r), 1, 0)});
     }},
    {"factor beyond single", true,
     [](auto& r) { shade_all(r, Illumination::whitted, WhittedMaterial{.diffuse = Rgb(1e39)}); }},
    {"ior", true,
     [](auto& r) {
         shade_all(r, Illumination::general, GeneralMaterial{.ior = -r.below(2) * 1.0});
     }},
    {"ior beyond single", true,
     [](auto& r) { shade_all(r, Illumination::general, GeneralMaterial{.ior = 1e-60}); }},
    {"shininess", true,
     [](auto& r) { shade_all(r, Illumination::sketch, SketchMaterial{.shininess = 1e300}); }},
    {"reflectance", true,
     [](auto& r) {
         shade_all(r, Illumination::shader, ShaderMaterial{{0, 1, unreal(r), 1}});
     }},
    {"growing light", true,
     [](auto& r) {
         shade_all(r, Illumination::general, GeneralMaterial{.reflect = Rgb(1e3)});
         r.scene.max_depth = 64;
     }},
    {"colour", true,
     [](auto& r) {
         Object& object = last_as(r, packtrace::sphere({0, 0, 3}, 1));
         r.scene.illumination = Illumination::shader;
         for (Object& each : r.scene.objects)
             each.material = make_material(Illumination::shader);
         r.scene.depth_limit = DepthLimit::local;
         object.material.color = {0, r.chance(0.5) ? 1.5 : unreal(r), 0};
     }},
    {"colour of no use", false,
     [](auto& r) {
         shade_all(r, Illumination::general, GeneralMaterial{});
         r.scene.objects[0].material.color = Rgb(0.5);
     }},
    {"checker of a ball", false,
     [](auto& r) {
         shade_all(r, Illumination::scratch, ScratchMaterial{});
         last_as(r, packtrace::sphere({0, 0, 3}, 1)).material.checker = Checker{};
     }},
    {"checker without size", true,
     [](auto& r) {
         shade_all(r, Illumination::scratch, ScratchMaterial{});
         last_as(r, packtrace::plane({0, 0, 3}, {0, 1, 0})).material.checker =
             Checker{Rgb(0.0), -r.below(2) * 1.0};
     }},
    {"axes of another normal", false,
     [](auto& r) {
         shade_all(r, Illumination::scratch, ScratchMaterial{});
         last_as(r, Plane{.normal = {1, 0, 0}}).material.checker = Checker{};
     }},
    {"no such model", false, [](auto& r) { r.scene.illumination = static_cast<Illumination>(9); }},
};

inline constexpr Break scene_breaks[] = {
    {"size", true, [](auto& r) { r.scene.width = -r.below(2); }},
    {"large size", true, [](auto& r) { r.scene.height = 65537; }},
    {"depth", true, [](auto& r) { r.scene.max_depth = r.chance(0.5) ? -1 : 65; }},
    {"weight", true, [](auto& r) { r.scene.min_weight = r.chance(0.5) ? 1.5 : unreal(r); }},
    {"background", true, [](auto& r) { r.scene.background.g = unreal(r); }},
    {"sample", true, [](auto& r) { r.scene.camera.pixel_sample.x = 1.5; }},
    {"viewport", true, [](auto& r) { r.scene.camera.viewport.y = 0; }},
    {"distance", true, [](auto& r) { r.scene.camera.distance = unreal(r); }},
    {"limit of another model", false,
     [](auto& r) {
         r.scene.illumination = Illumination::shader;
         for (Object& object : r.scene.objects)
             object.material = make_material(Illumination::shader);
         r.scene.depth_limit = DepthLimit::background;
     }},
    {"no such shadows", false, [](auto& r) { r.scene.shadows = static_cast<ShadowKind>(-1); }},
    {"eye", true, [](auto& r) { r.scene.camera.position.z = unreal(r); }},
    {"far eye", true, [](auto& r) { r.scene.camera.position.z = 1e16; }},
    {"angle", true, [](auto& r) { r.scene.camera.fov = r.chance(0.5) ? 180 : -1; }},
    {"unreal angle", true, [](auto& r) { r.scene.camera.fov = unreal(r); }},
    {"no rotation", true, [](auto& r) { r.scene.camera.rotation[1] *= 1.01; }},
    {"unreal rotation", true, [](auto& r) { r.scene.camera.rotation[2][0] = unreal(r); }},
    {"intensity", true,
     [](auto& r) { r.scene.lights.push_back(ambient_light(Rgb(0.5, -0.5, 0))); }},
    {"intensity beyond single", true,
     [](auto& r) { r.scene.lights.push_back(ambient_light(Rgb(1e39))); }},
    {"unreal place of a light", true,
     [](auto& r) {
         r.scene.lights.push_back(packtrace::point_light({0, unreal(r), 0}, Rgb(1.0)));
     }},
    {"light from nowhere", true,
     [](auto& r) { r.scene.lights.push_back(directional_light(Vec3(0.0), Rgb(1.0))); }},
    {"place of ambient light", false,
     [](auto& r) {
         r.scene.lights.push_back(ambient_light(Rgb(1.0)));
         r.scene.lights.back().vector = {1, 2, 3};
     }},
    {"ambient light without shadows", false,
     [](auto& r) {
         r.scene.lights.push_back(ambient_light(Rgb(1.0)));
         r.scene.lights.back().casts_shadow = false;
     }},
    {"no such light", false,
     [](auto& r) {
         r.scene.lights.push_back({static_cast<LightType>(5), Rgb(1.0), {}});
     }},
    {"quoted name", false, [](auto& r) { r.scene.objects[0].name = "a \"b\""; }},
    {"name of two lines", false, [](auto& r) { r.scene.objects[0].name = "a\nb"; }},
    {"long name", false, [](auto& r) { r.scene.objects[0].name.assign(5000, 'x'); }},
    {"quoted material", false, [](auto& r) { r.scene.objects[0].material.name = "a \"b\""; }},
    {"no frames", true,
     [](auto& r) {
         r.scene.animation = Animation{0, Orbit{r.scene.camera.position + Vec3(1, 0, 0)}, {}};
     }},
    {"nothing moves", true,
     [](auto& r) {
         r.scene.animation = Animation{9, {}, {}};
     }},
    {"eye on the axis", true,
     [](auto& r) {
         r.scene.animation = Animation{9, Orbit{r.scene.camera.position}, {}};
     }},
    {"late key", true,
     [](auto& r) {
         r.scene.animation = Animation{9, {}, {CameraKey{0}, CameraKey{9}}};
     }},
    {"keys in disorder", true,
     [](auto& r) {
         r.scene.animation = Animation{9, {}, {CameraKey{5}, CameraKey{2}}};
     }},
    {"blind key", true,
     [](auto& r) {
         r.scene.animation = Animation{9, {}, {CameraKey{0}, CameraKey{2, {0, 0, 1}, {0, 0, 1}}}};
     }},
};

[[nodiscard]] inline std::vector<Break> all_breaks()
{
    std::vector<Break> all;
    for (const std::span<const Break> breaks : std::initializer_list<std::span<const Break>>{
             surface_breaks, transform_breaks, material_breaks, scene_breaks})
        all.insert(all.end(), breaks.begin(), breaks.end());
    return all;
}

}  // namespace packtrace::test
