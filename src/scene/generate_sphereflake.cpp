#include <packtrace/generate.hpp>

#include "scene/generate_setting.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace packtrace {
namespace {

constexpr double shrink = 1.0 / 3.0;  ///< of a child against its parent

using Children = std::array<Vec3, 9>;

/// Where the children of a sphere sit that grows along +z: six around its equator and three
/// above them, neighbours 60 degrees apart, as in a close packing of balls.
Children child_directions()
{
    constexpr double sixth = std::numbers::pi / 3.0;
    const double rise = std::sqrt(2.0 / 3.0);
    const double spread = std::sqrt(1.0 / 3.0);
    Children directions;
    for (std::size_t i = 0; i < 6; ++i) {
        const double angle = sixth * (static_cast<double>(i) + 0.5);
        directions[i] = {std::cos(angle), std::sin(angle), 0.0};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double angle = 2.0 * sixth * static_cast<double>(i);
        directions[6 + i] = {spread * std::cos(angle), spread * std::sin(angle), rise};
    }
    return directions;
}

/// The smallest turn that takes +z to the unit vector `to`.
Mat3 turn_from_z(const Vec3& to)
{
    const double toward = 1.0 + to.z;
    // Straight back there is no smallest turn; half a turn about x is as good as any.
    if (toward < 1e-12)
        return {1, 0, 0, 0, -1, 0, 0, 0, -1};
    const double shear = -to.x * to.y / toward;
    return {1.0 - to.x * to.x / toward,
            shear,
            -to.x,
            shear,
            1.0 - to.y * to.y / toward,
            -to.y,
            to.x,
            to.y,
            to.z};
}

class Grower {
public:
    Grower(Scene& scene, Material material) : scene_(scene), material_(std::move(material))
    {
    }

    /// A sphere that grows along the unit vector `axis`, and `depth` generations on it.
    void grow(const Vec3& center, const Vec3& axis, double radius, int depth)
    {
        generators::add_sphere(scene_, center, radius, material_);
        if (depth == 0)
            return;
        const Mat3 turn = turn_from_z(axis);
        for (const Vec3& child : directions_) {
            const Vec3 outward = glm::normalize(turn * child);
            grow(center + radius * (1.0 + shrink) * outward, outward, radius * shrink, depth - 1);
        }
    }

private:
    Scene& scene_;
    Material material_;
    Children directions_ = child_directions();
};

void add_ground(Scene& scene)
{
    Plane plane;
    plane.point = {0.0, 0.0, -0.5};
    plane.normal = {0.0, 0.0, 1.0};
    plane_axes(plane);
    Object& object = scene.objects.emplace_back();
    object.name = "plane 1";
    object.surface = plane;
    object.material.name = "ground";
    object.material.color = {1.0, 0.75, 0.33};
}

std::vector<Light> three_lamps()
{
    std::vector<Light> lights{{LightType::ambient, Rgb(0.1), Vec3(0.0)}};
    for (const Vec3& position : {Vec3{4, 3, 2}, Vec3{1, -4, 4}, Vec3{-3, 1, 5}})
        lights.push_back({LightType::point, Rgb(0.3), position});
    return lights;
}

}  // namespace

Scene generate_sphereflake(const SphereflakeOptions& options)
{
    generators::check_option("depth", options.depth, 0, 7);
    const Vec3 up{0.0, 0.0, 1.0};
    Scene scene = generators::empty_scene({2.1, 1.3, 1.7}, Vec3(0.0), up);
    scene.background = {0.078, 0.361, 0.753};
    Grower grower(scene, generators::shiny("flake", {1.0, 0.9, 0.7}, options.reflective));
    grower.grow(Vec3(0.0), up, 0.5, options.depth);
    scene.lights = options.ground ? three_lamps() : generators::lamp_at({4, 3, 2});
    if (options.ground)
        add_ground(scene);
    return scene;
}

}  // namespace packtrace
