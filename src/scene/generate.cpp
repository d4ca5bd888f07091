#include "scene/language/numbers.hpp"
#include <packtrace/generate.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace packtrace {
namespace {

using language::to_text;

/// The common part of all generated scenes: 1024 x 1024 pixels, samples at their centres, a field
/// of view of 45 degrees.
Scene empty_scene(const Vec3& eye, const Vec3& target, const Vec3& up)
{
    Scene scene{.width = 1024, .height = 1024};
    scene.camera.position = eye;
    scene.camera.rotation = look_at(eye, target, up);
    scene.camera.fov = 45.0;
    scene.camera.pixel_sample = {0.5, 0.5};
    return scene;
}

/// A point light and a weak ambient light; their intensities add up to 1.
std::vector<Light> lamp_at(const Vec3& position)
{
    return {{LightType::ambient, Rgb(0.2), Vec3(0.0)}, {LightType::point, Rgb(0.8), position}};
}

/// Throws std::invalid_argument `name: …` unless low <= value <= high.
void check_option(const std::string& name, double value, double low, double high)
{
    if (!(value >= low && value <= high))
        throw std::invalid_argument(name + ": " + to_text(value) +
                                    " is out of range; use a number from " + to_text(low) + " to " +
                                    to_text(high));
}

/// Throws std::invalid_argument unless `radius` is finite and above 0.
void check_radius(double radius)
{
    if (!(radius > 0.0 && std::isfinite(radius)))
        throw std::invalid_argument("radius: " + to_text(radius) +
                                    " is out of range; use a finite number above 0");
}

/// A named scratch material with a highlight.
Material shiny(const std::string& name, const Rgb& color, double reflective)
{
    check_option("reflective", reflective, 0.0, 1.0);
    Material material;
    material.name = name;
    material.color = color;
    material.model = ScratchMaterial{50.0, reflective};
    return material;
}

/// Appends a sphere with the name that the reader would give it.
void add_sphere(Scene& scene, const Vec3& center, double radius, const Material& material)
{
    Object& object = scene.objects.emplace_back();
    object.name = "sphere " + std::to_string(scene.objects.size());
    object.surface = Sphere{center, radius};
    object.material = material;
}

/// Number `counter` of the sequence of `seed`, by the mixer of Steele, Lea, Flood, Fast Splittable
/// Pseudorandom Number Generators, 2014. It needs no state.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter)
{
    std::uint64_t bits = seed + (counter + 1) * 0x9E3779B97F4A7C15u;
    bits = (bits ^ (bits >> 30u)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27u)) * 0x94D049BB133111EBu;
    return bits ^ (bits >> 31u);
}

/// A multiple of 1e-7 in [0, 1).
double coordinate(std::uint64_t bits)
{
    constexpr std::uint64_t steps = 10'000'000;
    return static_cast<double>(bits % steps) / static_cast<double>(steps);
}

constexpr double shrink = 1.0 / 3.0;  ///< radius of a child / radius of its parent

using Children = std::array<Vec3, 9>;

/// Directions from a sphere that grows along +z to its children: six around its equator and three
/// above them. Neighbours are 60 degrees apart, as in a close packing of balls.
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

/// The rotation by the smallest angle that takes +z to the unit vector `to`.
Mat3 turn_from_z(const Vec3& to)
{
    const double toward = 1.0 + to.z;
    // For -z the axis is not unique. Take half a turn about x.
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

    /// Adds a sphere that grows along the unit vector `axis`, and `depth` generations of children.
    void grow(const Vec3& center, const Vec3& axis, double radius, int depth)
    {
        add_sphere(scene_, center, radius, material_);
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
    Plane plane{.point = {0.0, 0.0, -0.5}, .normal = {0.0, 0.0, 1.0}};
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
    check_option("depth", options.depth, 0, 7);
    const Vec3 up{0.0, 0.0, 1.0};
    Scene scene = empty_scene({2.1, 1.3, 1.7}, Vec3(0.0), up);
    scene.background = {0.078, 0.361, 0.753};
    Grower grower(scene, shiny("flake", {1.0, 0.9, 0.7}, options.reflective));
    grower.grow(Vec3(0.0), up, 0.5, options.depth);
    scene.lights = options.ground ? three_lamps() : lamp_at({4, 3, 2});
    if (options.ground)
        add_ground(scene);
    return scene;
}

Scene generate_random_spheres(const RandomSpheresOptions& options)
{
    check_option("count", options.count, 1, 10'000'000);
    check_radius(options.radius);
    const Material material = shiny("ball", {0.9, 0.7, 0.4}, options.reflective);
    Scene scene = empty_scene({1.58, 1.31, -0.688}, Vec3(0.5), {0, 1, 0});
    scene.lights = lamp_at({2.5, 2.5, -2});
    const auto count = static_cast<std::uint64_t>(options.count);
    scene.objects.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        Vec3 center;
        for (int axis = 0; axis < 3; ++axis)
            center[axis] =
                coordinate(random_bits(options.seed, 3 * i + static_cast<std::uint64_t>(axis)));
        add_sphere(scene, center, options.radius, material);
    }
    return scene;
}

Scene generate_lattice(const LatticeOptions& options)
{
    check_option("edge", options.edge, 1, 215);
    check_radius(options.radius);
    const Material material = shiny("ball", {0.5, 0.8, 0.6}, options.reflective);
    Scene scene = empty_scene({1.58, 1.31, -0.688}, Vec3(0.5), {0, 1, 0});
    scene.lights = lamp_at({2.5, 2.5, -2});
    const double cell = 1.0 / options.edge;
    for (int z = 0; z < options.edge; ++z)
        for (int y = 0; y < options.edge; ++y)
            for (int x = 0; x < options.edge; ++x)
                add_sphere(scene, cell * (Vec3(x, y, z) + 0.5), cell * options.radius, material);
    return scene;
}

}  // namespace packtrace
