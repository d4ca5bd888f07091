#pragma once

#include <packtrace/scene.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

// Scenes for tests and benchmarks of the packet kernels, built in code.
namespace packtrace::test {

[[nodiscard]] inline Material scratch(const Rgb& color, double specular, double reflective)
{
    Material material;
    material.color = color;
    material.model = ScratchMaterial{specular, reflective};
    return material;
}

inline void add_object(Scene& scene, const Surface& surface, const Material& material)
{
    Object object;
    object.name = "object " + std::to_string(scene.objects.size());
    object.surface = surface;
    object.material = material;
    scene.objects.push_back(object);
}

inline void add_sphere(Scene& scene, const Vec3& center, double radius, const Material& material)
{
    add_object(scene, Sphere{center, radius}, material);
}

inline void add_plane(Scene& scene, const Vec3& point, const Vec3& normal, const Material& material)
{
    Plane plane{.point = point, .normal = glm::normalize(normal)};
    plane_axes(plane);
    add_object(scene, plane, material);
}

inline void set_size(Scene& scene, int width, int height)
{
    scene.width = width;
    scene.height = height;
}

/// Note 001's ambient, point and directional light.
[[nodiscard]] inline std::vector<Light> note_lights()
{
    return {{LightType::ambient, Rgb(0.2), Vec3(0.0)},
            {LightType::point, Rgb(0.6), {2, 1, 0}},
            {LightType::directional, Rgb(0.2), {1, 4, 4}}};
}

/// Note 001's scene: three unit spheres on one of radius 5000.
[[nodiscard]] inline Scene four_spheres(int width, int height)
{
    Scene scene;
    set_size(scene, width, height);
    add_sphere(scene, {0, -1, 3}, 1, scratch({1, 0, 0}, 500, 0.2));
    add_sphere(scene, {-2, 1, 3}, 1, scratch({0, 0, 1}, 500, 0.3));
    add_sphere(scene, {2, 1, 3}, 1, scratch({0, 1, 0}, 10, 0.4));
    add_sphere(scene, {0, -5001, 0}, 5000, scratch({1, 1, 0}, 1000, 0.5));
    scene.lights = note_lights();
    return scene;
}

/// Random numbers for scenes; every compiler and library gives the same numbers.
class SceneRandom {
public:
    explicit SceneRandom(unsigned seed) : random_(seed)
    {
    }
    [[nodiscard]] double between(double low, double high)
    {
        constexpr double scale = 1.0 / 4294967296.0;
        return low + (high - low) * scale * static_cast<double>(random_() & 0xffffffffu);
    }
    [[nodiscard]] Vec3 inside(const Vec3& low, const Vec3& high)
    {
        const double x = between(low.x, high.x);
        const double y = between(low.y, high.y);
        const double z = between(low.z, high.z);
        return {x, y, z};
    }
    [[nodiscard]] Material material()
    {
        const Rgb color = inside(Vec3(0.1), Vec3(1.0));
        const double kind = between(0.0, 1.0);
        const double specular = kind < 0.3 ? -1.0 : std::round(between(2.0, 900.0));
        const double reflective = kind < 0.6 ? 0.0 : between(0.05, 0.6);
        return scratch(color, specular, reflective);
    }

private:
    std::mt19937 random_;
};

/// `count` spheres of many sizes in the view, some inside each other.
[[nodiscard]] inline Scene random_spheres(int count, unsigned seed)
{
    SceneRandom random(seed);
    Scene scene;
    set_size(scene, 93, 61);
    scene.background = {0.1, 0.2, 0.3};
    for (int i = 0; i < count; ++i) {
        const Vec3 center = random.inside({-4, -3, 4}, {4, 3, 14});
        const double radius = random.between(0.1, 1.2);
        add_sphere(scene, center, radius, random.material());
    }
    scene.lights = note_lights();
    return scene;
}

/// Spheres in a room of six planes, with a checkered floor and back wall.
[[nodiscard]] inline Scene checkered_room(unsigned seed)
{
    SceneRandom random(seed);
    Scene scene;
    set_size(scene, 75, 53);
    const auto squares = [](Material material, const Rgb& other, double size) {
        material.checker = Checker{other, size};
        return material;
    };
    add_plane(scene, {0.3, -2, 0.7}, {0, 1, 0},
              squares(scratch({1, 1, 1}, -1, 0.3), {0.1, 0.1, 0.1}, 0.7));
    for (int i = 0; i < 6; ++i)
        add_sphere(scene, random.inside({-3, -1, 3}, {3, 2, 9}), random.between(0.3, 1.0),
                   random.material());
    add_plane(scene, {0, 0, 12}, {0.1, 0.2, -1}, squares(random.material(), {0, 0.3, 0.9}, 1.3));
    add_plane(scene, {0, 4, 0}, {0, -1, 0}, random.material());
    add_plane(scene, {-5, 0, 0}, {1, 0, 0.1}, random.material());
    add_plane(scene, {5, 0, 0}, {-1, 0, 0}, random.material());
    add_plane(scene, {0, 0, -3}, {0, 0, 1}, random.material());
    scene.lights = note_lights();
    scene.lights.push_back({LightType::point, {0.1, 0.2, 0.3}, {-3, 3, 4}});
    return scene;
}

}  // namespace packtrace::test
