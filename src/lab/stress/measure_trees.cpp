#include "lab/stress/stress_family.hpp"
#include "lab/stress/stress_measure.hpp"
#include "lab/stress/stress_subject.hpp"
#include "lab/truth/wide.hpp"
#include "render/precision.hpp"

#include <glm/geometric.hpp>

#include <cmath>

// Deep ray trees: in a room of mirrors, and inside a mirrored ball.
namespace packtrace::lab {
namespace {

using reference::dot;

constexpr int bounces = 12;

/// A tree takes as long as some hundred rays, so there is one tree for this many rays.
constexpr int rays_a_tree = 4;

/// Largest coordinate of the mirrors' positions, roughly.
constexpr double mirror_place = 10.0;

/// The ray origin offset of single precision and more, in roundoffs (RayRules::start_error).
constexpr double origin_offset = 64.0;

/// The direction's error by one reflection, in roundoffs.
constexpr double reflection_error = 8.0;

/// Two mirrors are told apart if their t differ by more than this many times the error of the
/// place.
constexpr double well_apart = 8.0;

/// Rays are followed until the error of their place is this large.
constexpr double largest_error = 1e-2;

Object mirror(Object object)
{
    object.material.model = GeneralMaterial{.reflect = Rgb(1.0)};
    return object;
}

Object wall(const Vec3& point, const Vec3& normal)
{
    return mirror(plane_object(point, normal));
}

enum class Mirrors { room, ball };

/// Six mirrors around `middle`, nearly at right angles.
std::vector<Object> walls_around(const Vec3& middle, StressRandom& random)
{
    std::vector<Object> walls;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal(0.0);
            normal[axis] = side;
            normal = glm::normalize(normal + 0.1 * random.box(1.0));
            walls.push_back(wall(middle + random.between(1.0, 3.0) * normal, -normal));
        }
    return walls;
}

template <class Real>
Scene mirror_scene(StressRandom& random, Mirrors mirrors)
{
    Scene scene{.illumination = Illumination::general};
    const Vec3 middle = random.box(3.0);
    if (mirrors == Mirrors::room)
        scene.objects = walls_around(middle, random);
    else
        scene.objects = {mirror(sphere_object(middle, random.between(0.5, 5.0)))};
    round_to_precision<Real>(scene);
    scene.camera = measure_camera(middle + random.box(0.2), random.unit(), 1.0);
    scene.width = scene.height = measure_edge;
    scene.max_depth = bounces;
    return scene;
}

/// The true ray after some bounces, and how far a kernel's ray may be off it, in roundoffs.
struct Path {
    WideVec org;
    WideVec dir;
    int left = -1;             ///< the object that it leaves
    double place_error = 0.0;  ///< of the origin
    double turn_error = 0.0;   ///< of the direction
};

/// The next hit with a mirror.
struct MirrorHit {
    Wide t = 0;  ///< 0 for no hit
    WideVec normal;
    double curvature = 0.0;
    int object = -1;
};

MirrorHit hit_with(const Object& object, int number, const Path& path)
{
    if (const Sphere* sphere = std::get_if<Sphere>(&object.surface)) {
        const WideVec o = path.org - wide(sphere->center);
        const Wide b = dot(o, path.dir);
        const Wide radius = sphere->radius;
        const Wide c = number == path.left ? Wide(0) : Wide(dot(o, o) - radius * radius);
        const Wide t = square_root(b * b - c) - b;
        return {t, (o + t * path.dir) / radius, 1.0 / sphere->radius, number};
    }
    const Plane& plane = std::get<Plane>(object.surface);
    const WideVec normal = wide(plane.normal);
    if (number == path.left)
        return {};
    return {dot(normal, wide(plane.point) - path.org) / dot(normal, path.dir), normal, 0.0, number};
}

/// The closest hit, and the t of the second closest; 0 for none.
struct ClosestMirrors {
    MirrorHit first;
    Wide second = 0;
};

ClosestMirrors closest_mirrors(const Scene& scene, const Path& path)
{
    ClosestMirrors closest;
    for (int i = 0; i < static_cast<int>(scene.objects.size()); ++i) {
        const MirrorHit hit = hit_with(scene.objects[static_cast<std::size_t>(i)], i, path);
        if (!(hit.t > 0))
            continue;
        if (closest.first.object >= 0 && hit.t >= closest.first.t) {
            closest.second = closest.second > 0 && closest.second < hit.t ? closest.second : hit.t;
            continue;
        }
        closest.second = closest.first.t;
        closest.first = hit;
    }
    return closest;
}

double size_of(const WideVec& v)
{
    return glm::length(narrow(v));
}

/// Follows a ray to its next mirror; false where its errors may make it hit another one.
bool bounce(const Scene& scene, Path& path, double roundoff)
{
    const auto [hit, second] = closest_mirrors(scene, path);
    const double t = static_cast<double>(hit.t);
    const Wide slope = dot(hit.normal, path.dir);
    const double cosine = std::abs(static_cast<double>(slope));
    const WideVec P = path.org + hit.t * path.dir;
    // The places of the mirror and of the ray's start are each rounded, and the ray origin is
    // offset.
    const double offset = path.left < 0 ? 0.0 : origin_offset * size_of(path.org);
    const double places = size_of(path.org) + size_of(P) + t + mirror_place + offset;
    path.place_error = (path.place_error + path.turn_error * t + places) / cosine;
    const bool decided = second == 0 || static_cast<double>(second - hit.t) >
                                            well_apart * roundoff * path.place_error;
    path.turn_error += 2.0 * hit.curvature * path.place_error + reflection_error;
    path.org = P;
    path.dir = path.dir - 2 * slope * hit.normal;
    path.left = hit.object;
    return decided && hit.object >= 0 && path.place_error * roundoff < largest_error;
}

/// Compares a tree's rays with the truth, as long as bounce() decides their mirrors; returns the
/// error of the last one, in roundoffs.
template <class Real>
double evaluate_bounces(const Scene& scene, const RayNode& tree, MeasureRun& run)
{
    const double roundoff = roundoff_of<Real>;
    Errors& errors = run.errors;
    Path path{wide(tree.org), wide(tree.dir)};
    path.dir = path.dir / square_root(dot(path.dir, path.dir));
    double last = 0.0;
    for (const RayNode* ray = &tree; ray != nullptr;
         ray = ray->children.empty() ? nullptr : &ray->children[0]) {
        run.answers.insert(run.answers.end(), {ray->point.x, ray->point.y, ray->point.z});
        if (!bounce(scene, path, roundoff)) {
            ++errors.undecided;
            return last;
        }
        if (ray->object != path.left) {
            ++errors.beyond_own_band;
            return last;
        }
        ++errors.hits;
        errors.not_finite += !std::isfinite(ray->point.x + ray->point.y + ray->point.z);
        const double error = largest(wide(ray->point) - path.org);
        errors.rho = std::max(errors.rho, error / (roundoff * path.place_error));
        last = error / (roundoff * largest(path.org));
    }
    return last;
}

template <class Real>
void evaluate_tree(const Scene& scene, const RayNode& tree, MeasureRun& run)
{
    ++run.errors.rays;
    const double off = evaluate_bounces<Real>(scene, tree, run);
    run.errors.distance = std::max(run.errors.distance, off);
    run.errors.ulp.push_back(static_cast<float>(off / 2.0));
}

template <class Real>
StressMeasure::Ask prepared(const StressOptions& options, Mirrors mirrors)
{
    return ask_of_trees<Real>(
        options.seed, options.rays / rays_a_tree,
        [=](StressRandom& random) { return mirror_scene<Real>(random, mirrors); },
        evaluate_tree<Real>);
}

StressMeasure measure(const char* name, const char* what, Mirrors mirrors)
{
    return {name, what, [=](Precision precision, const StressOptions& options) {
                return with_packet_real(
                    precision, [&]<class Real>() { return prepared<Real>(options, mirrors); });
            }};
}

}  // namespace

std::vector<StressMeasure> tree_measures()
{
    return {measure("mirror-room", "twelve bounces between six mirrors", Mirrors::room),
            measure("mirror-ball", "twelve bounces inside a mirrored ball", Mirrors::ball)};
}

}  // namespace packtrace::lab
