#pragma once

#include "scenes.hpp"

// Scenes whose camera rays are hard cases of ray tests: far, tiny, anchored and grazed objects.
namespace packtrace::test {

struct RayFamily {
    const char* name;
    Scene scene;
};

/// Spheres of radius up to `size` around a point straight ahead; together they fill the picture.
[[nodiscard]] inline Scene cluster(double distance, double size, unsigned seed)
{
    SceneRandom random(seed);
    Scene scene;
    set_size(scene, 96, 96);
    scene.camera.fov = 2.0 * 57.29577951308232 * std::atan(3.0 * size / distance);
    for (int i = 0; i < 12; ++i) {
        const Vec3 offset = random.inside(Vec3(-2.0 * size), Vec3(2.0 * size));
        const double radius = random.between(0.2 * size, size);
        add_sphere(scene, Vec3(0, 0, distance) + offset, radius, scratch(Rgb(1), -1, 0));
    }
    return scene;
}

/// Spheres around the eye, each inside the next, with the eye off their centres.
[[nodiscard]] inline Scene shells()
{
    Scene scene;
    set_size(scene, 96, 96);
    scene.camera.fov = 120.0;
    for (int i = 0; i < 6; ++i)
        add_sphere(scene, {0.1 * i, -0.2, 0.15 * i}, 0.4 + 0.35 * i, scratch(Rgb(1), -1, 0));
    return scene;
}

/// The ground of note 001 with another radius, its top at y = -1, and the eye above it.
[[nodiscard]] inline Scene ground(double radius, double eye)
{
    Scene scene;
    set_size(scene, 96, 96);
    scene.camera.position = {0.3, eye, 0.2};
    add_sphere(scene, {0, -1 - radius, 0}, radius, scratch(Rgb(1), -1, 0));
    add_sphere(scene, {0.5, 0, 6}, 1, scratch(Rgb(1), -1, 0));
    return scene;
}

/// Planes of any slope, and a floor just below the eye that most rays graze.
[[nodiscard]] inline Scene planes(unsigned seed)
{
    SceneRandom random(seed);
    Scene scene;
    set_size(scene, 96, 96);
    for (int i = 0; i < 5; ++i) {
        const Vec3 point = random.inside({-9, -9, 5}, {9, 9, 40});
        const Vec3 normal = random.inside(Vec3(-1), Vec3(1));
        add_plane(scene, point, normal, scratch(Rgb(1), -1, 0));
    }
    add_plane(scene, {0, -0.01, 0}, {0, 1, 0}, scratch(Rgb(1), -1, 0));
    return scene;
}

[[nodiscard]] inline std::vector<RayFamily> sphere_families()
{
    return {
        {"23 spheres in view", random_spheres(23, 11)},
        {"200 spheres in view", random_spheres(200, 12)},
        {"near spheres", cluster(8, 1, 13)},
        {"spheres a thousand radii away", cluster(1000, 1, 14)},
        {"spheres a hundred thousand radii away", cluster(1e5, 1, 15)},
        {"tiny spheres", cluster(1.5, 1.5e-5, 16)},
        {"the eye inside spheres", shells()},
    };
}

[[nodiscard]] inline std::vector<RayFamily> plane_families()
{
    return {{"planes", planes(17)}, {"more planes", planes(18)}, {"a room", checkered_room(19)}};
}

[[nodiscard]] inline std::vector<RayFamily> anchored_families()
{
    return {
        {"note 001", four_spheres(160, 160)},
        {"a ground of radius 5000", ground(5000, 0)},
        {"a ground of radius a million", ground(1e6, 0)},
        {"a ground of radius a million, from high", ground(1e6, 30)},
    };
}

}  // namespace packtrace::test
