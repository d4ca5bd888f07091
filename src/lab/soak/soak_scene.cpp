#include "lab/soak/soak_scene.hpp"

#include "lab/stress/placed_quadric.hpp"
#include "scene/language/keys.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace packtrace::lab {
namespace {

// Shares and ranges below are choices of the search: they make each feature frequent, and none
// needed.

constexpr int quadric_kinds = 7;  // all but the general one

/// Exponents go up to the largest one of the notes, that of note 001's ground sphere.
constexpr double most_shininess = 1000.0;

/// The radius of a ground sphere, in units of the scene, as in note 001; and how far below the
/// middle of the scene its centre is, in radii.
constexpr double ground_radius = 5000.0;
constexpr double ground_depth = 1.0006;

bool chance(StressRandom& random, double share)
{
    return random.between(0.0, 1.0) < share;
}

Rgb any_factor(StressRandom& random, double most)
{
    if (chance(random, 0.2))
        return Rgb(0.0);
    if (chance(random, 0.5))
        return Rgb(random.between(0.0, most));
    const Vec3 v = random.box(0.5 * most);
    return v + Vec3(0.5 * most);
}

double any_ior(StressRandom& random)
{
    return chance(random, 0.3) ? 1.0 : random.power(0.4, 2.5);
}

double any_shininess(StressRandom& random)
{
    return chance(random, 0.3) ? static_cast<double>(random.below(40))
                               : random.power(0.1, most_shininess);
}

void fill(StressRandom& random, ScratchMaterial& model)
{
    model.specular = chance(random, 0.4) ? -1.0 : any_shininess(random);
    model.reflective = chance(random, 0.5) ? 0.0 : random.between(0.0, 1.0);
}

void fill(StressRandom& random, SketchMaterial& model)
{
    model.ambient = any_factor(random, 1.0);
    model.diffuse = any_factor(random, 1.0);
    model.specular = any_factor(random, 0.5);
    model.refractive = any_factor(random, 0.5);
    model.shininess = any_shininess(random);
    model.ior = any_ior(random);
}

void fill(StressRandom& random, WhittedMaterial& model)
{
    model.ambient = any_factor(random, 1.0);
    model.diffuse = any_factor(random, 1.0);
    model.specular = any_factor(random, 0.5);
    model.transmissive = any_factor(random, 0.5);
    model.shininess = any_shininess(random);
    model.ior = any_ior(random);
}

void fill(StressRandom& random, ShaderMaterial& model)
{
    for (std::size_t i = 0; i < 3; ++i)
        model.reflectance[i] = random.between(0.0, 1.0);
    model.reflectance[3] = any_shininess(random);
}

void fill(StressRandom& random, GeneralMaterial& model)
{
    model.ambient = any_factor(random, 1.0);
    model.diffuse = any_factor(random, chance(random, 0.1) ? 1e6 : 1.0);
    model.highlight = any_factor(random, 1.0);
    model.reflect = any_factor(random, 0.5);
    model.transmit = any_factor(random, 0.5);
    model.shininess = any_shininess(random);
    model.ior = any_ior(random);
}

Material any_material(StressRandom& random, Illumination illumination)
{
    Material material = language::default_material(illumination);
    std::visit([&](auto& model) { fill(random, model); }, material.model);
    if (illumination != Illumination::general)
        material.color = random.box(0.5) + Vec3(0.5);
    return material;
}

/// A vector of any direction, `scale` to 10^5 times as long. Random numbers are drawn in separate
/// statements, here and below, because compilers evaluate the arguments of a call in any order.
Vec3 any_way(StressRandom& random, double scale)
{
    const Vec3 direction = random.unit();
    return scale * random.power(1.0, 1e5) * direction;
}

/// Sizes of a scene's objects: mostly of one order of magnitude, in some scenes of any.
class Sizes {
public:
    explicit Sizes(StressRandom& random)
        : scale_(chance(random, 0.25) ? random.power(1e-6, 1e6) : 1.0),
          spread_(chance(random, 0.25) ? 1e4 : 6.0),
          place_(chance(random, 0.1) ? any_way(random, scale_) : Vec3(0.0))
    {
    }
    [[nodiscard]] double length(StressRandom& random) const
    {
        return scale_ * random.power(1.0 / spread_, std::sqrt(spread_));
    }
    [[nodiscard]] Vec3 point(StressRandom& random, double half) const
    {
        return place_ + scale_ * random.box(half);
    }
    [[nodiscard]] double scale() const
    {
        return scale_;
    }

private:
    double scale_;
    double spread_;
    Vec3 place_;
};

Quadric any_quadric(StressRandom& random)
{
    Quadric quadric;
    if (chance(random, 0.15))
        for (double& coefficient : quadric.coefficients)
            coefficient = chance(random, 0.4) ? 0.0 : random.between(-2.0, 2.0);
    else
        quadric = packtrace::quadric(static_cast<QuadricKind>(random.below(quadric_kinds)));
    if (chance(random, 0.6)) {
        const double low = random.between(-2.0, 0.5);
        quadric.z_range = ZRange{low, low + random.power(1e-2, 3.0)};
        quadric.capped = chance(random, 0.5);
    }
    return quadric;
}

/// A regular polygon in the plane of two vectors.
std::vector<Vec3> ring(StressRandom& random, const Vec3& center, const Vec3& u, const Vec3& v)
{
    const int count = 3 + random.below(6);
    std::vector<Vec3> corners;
    for (int i = 0; i < count; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / count;
        corners.push_back(center + std::cos(turn) * u + std::sin(turn) * v);
    }
    return corners;
}

/// Its corners lie in a plane z = const, so that it is exactly flat; a transform turns it.
Polygon any_polygon(StressRandom& random, double size)
{
    Polygon polygon;
    const Vec3 u(size, 0.0, 0.0);
    const double height = size * random.power(0.1, 2.0);
    const Vec3 v(0.3 * size * random.between(-1.0, 1.0), height, 0.0);
    polygon.contours.push_back(ring(random, Vec3(0.0), u, v));
    if (chance(random, 0.4))
        polygon.contours.push_back(ring(random, Vec3(0.0), 0.4 * u, 0.4 * v));
    return polygon;
}

Mat4 any_matrix(StressRandom& random, double size, const Vec3& to)
{
    Vec3 stretch = size * any_stretch(random, chance(random, 0.1) ? 1e-3 : 0.3);
    if (chance(random, 0.2))
        stretch.x = -stretch.x;
    return any_placement(random, stretch, to);
}

Object any_body(StressRandom& random, const Sizes& sizes)
{
    const double size = sizes.length(random);
    const Vec3 to = sizes.point(random, 3.0);
    Object object;
    switch (random.below(10)) {
        case 0:
        case 1:
        case 2:
            object.surface = Sphere{to, size};
            break;
        case 3:
            object.surface = Sphere{Vec3(0.0), 1.0};
            object.transform = any_matrix(random, size, to);
            break;
        case 4: {
            Plane plane{to, random.unit(), {}, {}};
            plane_axes(plane);
            object.surface = plane;
            break;
        }
        case 5:
            object.surface = any_polygon(random, 1.0);
            object.transform = any_matrix(random, size, to);
            break;
        default:
            object.surface = any_quadric(random);
            object.transform = any_matrix(random, size, to);
    }
    return object;
}

/// The same object again, or a sphere that touches the one before.
Object any_neighbour(StressRandom& random, const Object& before)
{
    Object object = before;
    const auto* const sphere = std::get_if<Sphere>(&before.surface);
    if (sphere != nullptr && before.transform == Mat4(1.0) && chance(random, 0.7)) {
        const double radius = sphere->radius * random.power(0.1, 10.0);
        const double apart = sphere->radius + random.sign() * radius;
        object.surface = Sphere{sphere->center + apart * random.unit(), radius};
    }
    return object;
}

/// A ground sphere: so large that it is nearly a plane.
Object ground_below(const Object& first, const Sizes& sizes, StressRandom& random)
{
    Object ground{.material = first.material};
    ground.material.checker.reset();
    const double radius = ground_radius * sizes.scale();
    ground.surface =
        Sphere{sizes.point(random, 0.0) - Vec3(0.0, ground_depth * radius, 0.0), radius};
    return ground;
}

void add_objects(StressRandom& random, const Sizes& sizes, Scene& scene)
{
    const int count = chance(random, 0.1) ? 40 + random.below(160) : 1 + random.below(8);
    for (int i = 0; i < count; ++i) {
        const bool near = !scene.objects.empty() && chance(random, 0.15);
        Object object =
            near ? any_neighbour(random, scene.objects.back()) : any_body(random, sizes);
        if (scene.objects.empty() || chance(random, 0.7))
            object.material = any_material(random, scene.illumination);
        else
            object.material = scene.objects.back().material;
        object.material.checker.reset();
        if (std::holds_alternative<Plane>(object.surface) &&
            scene.illumination != Illumination::general && chance(random, 0.5))
            object.material.checker =
                Checker{random.box(0.5) + Vec3(0.5), sizes.scale() * random.power(0.1, 3.0)};
        object.casts_shadow = !chance(random, 0.1);
        scene.objects.push_back(std::move(object));
    }
    if (chance(random, 0.3))
        scene.objects.push_back(ground_below(scene.objects.front(), sizes, random));
}

void add_lights(StressRandom& random, const Sizes& sizes, Scene& scene)
{
    for (int i = 1 + random.below(4); i > 0; --i) {
        Light light{.intensity = any_factor(random, 1.0)};
        light.type = static_cast<LightType>(random.below(3));
        if (light.type == LightType::point)
            light.vector = sizes.point(random, 8.0);
        if (light.type == LightType::directional)
            light.vector = random.unit();
        light.casts_shadow = !chance(random, 0.1);
        scene.lights.push_back(light);
    }
}

void add_camera(StressRandom& random, const Sizes& sizes, Scene& scene)
{
    Camera& camera = scene.camera;
    // Some cameras are inside a body.
    camera.position = sizes.point(random, chance(random, 0.2) ? 1.0 : 8.0);
    const Vec3 up = random.unit();
    camera.rotation = look_at(camera.position, sizes.point(random, 1.5), up);
    camera.fov = random.between(15.0, 100.0);
    camera.pixel_sample = {random.between(0.0, 1.0), random.between(0.0, 1.0)};
}

}  // namespace

Scene soak_scene(StressRandom& random)
{
    Scene scene{.width = 3 + random.below(30),
                .height = 3 + random.below(24),
                .illumination = static_cast<Illumination>(random.below(5)),
                .max_depth = random.below(6),
                .shadows = static_cast<ShadowKind>(random.below(3))};
    scene.background = random.box(0.5) + Vec3(0.5);
    if (scene.illumination == Illumination::general)
        scene.depth_limit = static_cast<DepthLimit>(random.below(2));
    if (chance(random, 0.1))
        scene.min_weight = random.power(1e-4, 0.3);
    const Sizes sizes(random);
    add_objects(random, sizes, scene);
    add_lights(random, sizes, scene);
    add_camera(random, sizes, scene);
    return scene;
}

Vec3 point_near(StressRandom& random, const Object& object)
{
    Vec3 own(0.0);
    if (const auto* const sphere = std::get_if<Sphere>(&object.surface)) {
        const Vec3 direction = random.unit();
        own = sphere->center + random.between(0.9, 1.02) * sphere->radius * direction;
    } else if (const auto* const plane = std::get_if<Plane>(&object.surface)) {
        const double v = random.between(-3.0, 3.0);
        own = plane->point + random.between(-3.0, 3.0) * plane->u + v * plane->v;
    } else if (const auto* const polygon = std::get_if<Polygon>(&object.surface)) {
        const auto& corners = polygon->contours[0];
        const auto others = static_cast<int>(corners.size()) - 2;
        const auto corner = static_cast<std::size_t>(2 + random.below(others));
        // Not next to an edge, where rounding decides what a ray hits.
        const Vec3 middle = 0.5 * (corners[1] + corners[corner]);
        own = glm::mix(corners[0], middle, random.between(0.03, 1.3));
    } else {
        const Quadric& quadric = std::get<Quadric>(object.surface);
        own = quadric.kind == QuadricKind::general ? random.box(2.0)
                                                   : own_surface_point(random, quadric.kind);
        if (quadric.z_range && random.below(4) == 0)
            own.z = random.below(2) == 0 ? quadric.z_range->low : quadric.z_range->high;
    }
    return to_world(object.transform, own);
}

}  // namespace packtrace::lab
