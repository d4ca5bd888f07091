#pragma once

#include "scenes.hpp"

#include <algorithm>
#include <functional>

// Scenes that reach every branch of the packet kernels. Each is small and has odd sides, so that
// tiles are cut at the right and lower edge.
namespace packtrace::test {

struct NamedScene {
    const char* name;
    Scene scene;
};

/// The scene after `change`.
[[nodiscard]] inline Scene changed(Scene scene, const std::function<void(Scene&)>& change)
{
    change(scene);
    return scene;
}

/// Note 001's scene, and variants with parts removed or changed.
[[nodiscard]] inline std::vector<NamedScene> note_scenes()
{
    const Scene note = four_spheres(75, 53);
    return {
        {"note 001", note},
        {"no lights", changed(note, [](Scene& s) { s.lights.clear(); })},
        {"no shadows", changed(note, [](Scene& s) { s.shadows = ShadowKind::none; })},
        {"no mirrors traced", changed(note, [](Scene& s) { s.max_depth = 0; })},
        {"eight mirrorings", changed(note, [](Scene& s) { s.max_depth = 8; })},
        {"no objects", changed(note,
                               [](Scene& s) {
                                   s.objects.clear();
                                   s.background = {0.25, 0.5, 0.75};
                               })},
        {"nothing in view", changed(note,
                                    [](Scene& s) {
                                        s.camera.position = {0, 50, 10};
                                    })},
        {"one column", changed(note, [](Scene& s) { set_size(s, 1, 40); })},
        {"one row", changed(note, [](Scene& s) { set_size(s, 40, 1); })},
        {"whole tiles", changed(note, [](Scene& s) { set_size(s, 64, 32); })},
        {"one pixel more than a tile", changed(note, [](Scene& s) { set_size(s, 17, 17); })},
        {"37 x 21", changed(note, [](Scene& s) { set_size(s, 37, 21); })},
        {"centres of pixels", changed(note, [](Scene& s) { s.camera.pixel_sample = Vec2(0.5); })},
    };
}

/// Scenes with lights and eyes in unusual places.
[[nodiscard]] inline std::vector<NamedScene> placement_scenes()
{
    const Scene note = four_spheres(75, 53);
    return {
        {"coloured lights",
         changed(note,
                 [](Scene& s) {
                     s.lights[0].intensity = {0.3, 0.1, 0.2};
                     s.lights[1].intensity = {0.9, 0.4, 0.0};
                     s.lights[2].intensity = {0.0, 0.2, 0.8};
                     s.lights.push_back({LightType::ambient, {0.0, 0.05, 0.0}, Vec3(0.0)});
                 })},
        {"a light inside a sphere", changed(note,
                                            [](Scene& s) {
                                                s.lights[1].vector = {0.1, -0.8, 2.9};
                                            })},
        {"a light under the ground", changed(note,
                                             [](Scene& s) {
                                                 s.lights[1].vector = {0.3, -3.1, 2.0};
                                             })},
        {"the eye inside a sphere",
         changed(note,
                 [](Scene& s) {
                     s.camera.position = {0.2, -0.9, 2.8};
                     s.objects[0].material = scratch({0.8, 0.7, 0.6}, 20, 0.35);
                 })},
        {"the eye turned and high",
         changed(note,
                 [](Scene& s) {
                     s.camera.position = {5.1, 4.2, -3.3};
                     s.camera.rotation = look_at(s.camera.position, {0, 0, 3}, {0, 1, 0});
                 })},
        {"a light at the eye",
         changed(note, [](Scene& s) { s.lights[1].vector = s.camera.position; })},
        {"a mirror that leaves no colour of its own",
         changed(note,
                 [](Scene& s) {
                     s.objects[3].material = scratch({1, 1, 1}, -1, 1.0);
                 })},
    };
}

[[nodiscard]] inline std::vector<NamedScene> random_scenes()
{
    return {
        {"5 spheres", random_spheres(5, 1)},
        {"23 spheres", random_spheres(23, 2)},
        {"200 spheres", random_spheres(200, 3)},
        {"200 spheres, no shadows",
         changed(random_spheres(200, 4), [](Scene& s) { s.shadows = ShadowKind::none; })},
        {"a room", checkered_room(5)},
        {"a room, no mirrors traced",
         changed(checkered_room(6), [](Scene& s) { s.max_depth = 0; })},
        {"planes only", changed(checkered_room(7),
                                [](Scene& s) {
                                    std::erase_if(s.objects, [](const Object& object) {
                                        return std::holds_alternative<Sphere>(object.surface);
                                    });
                                })},
    };
}

[[nodiscard]] inline std::vector<NamedScene> packet_scenes()
{
    std::vector<NamedScene> scenes = note_scenes();
    for (const auto& more : {placement_scenes(), random_scenes()})
        scenes.insert(scenes.end(), more.begin(), more.end());
    return scenes;
}

}  // namespace packtrace::test
