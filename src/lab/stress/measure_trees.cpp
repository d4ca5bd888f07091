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

/// A tree of so many bounces takes as long as some hundred rays: there are fewer of them.
constexpr int sparse_trees = 4;

Object mirror(Object object)
{
    object.material.model = GeneralMaterial{.reflect = Rgb(1.0)};
    return object;
}

Object wall(const Vec3& point, const Vec3& normal)
{
    return mirror(plane_object(point, normal));
}

template <class Real>
Scene mirror_scene(StressRandom& random, bool room)
{
    Scene scene{.illumination = Illumination::general};
    const Vec3 middle = random.box(3.0);
    if (!room)
        scene.objects = {mirror(sphere_object(middle, random.between(0.5, 5.0)))};
    for (int axis = 0; room && axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal(0.0);
            normal[axis] = side;
            normal = glm::normalize(normal + 0.1 * random.box(1.0));
            scene.objects.push_back(wall(middle + random.between(1.0, 3.0) * normal, -normal));
        }
    round_to_precision<Real>(scene);
    scene.camera = measure_camera(middle + random.box(0.2), random.unit(), 1.0);
    scene.width = scene.height = measure_edge;
    scene.max_depth = bounces;
    return scene;
}

/// A ray on its way through the room, and how far it may be off after its bounces, in roundoffs:
/// its place, and its direction.
struct Path {
    WideVec org;
    WideVec dir;
    int left = -1;  ///< the object it leaves
    double place_error = 0.0;
    double turn_error = 0.0;
};

/// t of the way to the next hit with one object, and of which bend; 0 for none.
Wide way_to(const Object& object, int number, const Path& path, WideVec& normal, double& curvature)
{
    if (const Sphere* sphere = std::get_if<Sphere>(&object.surface)) {
        const WideVec o = path.org - wide(sphere->center);
        const Wide b = dot(o, path.dir);
        const Wide radius = sphere->radius;
        const Wide c = number == path.left ? Wide(0) : Wide(dot(o, o) - radius * radius);
        const Wide t = square_root(b * b - c) - b;
        normal = (o + t * path.dir) / radius;
        curvature = 1.0 / sphere->radius;
        return t;
    }
    const Plane& plane = std::get<Plane>(object.surface);
    normal = wide(plane.normal);
    curvature = 0.0;
    if (number == path.left)
        return 0;
    return dot(normal, wide(plane.point) - path.org) / dot(normal, path.dir);
}

double size_of(const WideVec& v)
{
    return glm::length(narrow(v));
}

/// Follows a ray to its next mirror; false where which one that is cannot be told.
bool bounce(const Scene& scene, Path& path, double roundoff)
{
    Wide nearest = 0;
    Wide second = 0;
    WideVec normal;
    double curvature = 0.0;
    int object = -1;
    for (int i = 0; i < static_cast<int>(scene.objects.size()); ++i) {
        WideVec n;
        double bend = 0.0;
        const Wide t = way_to(scene.objects[static_cast<std::size_t>(i)], i, path, n, bend);
        if (!(t > 0))
            continue;
        if (object >= 0 && t >= nearest) {
            second = second > 0 && second < t ? second : t;
            continue;
        }
        second = nearest;
        nearest = t;
        normal = n;
        curvature = bend;
        object = i;
    }
    const double t = static_cast<double>(nearest);
    const Wide slope = dot(normal, path.dir);
    const double cosine = std::abs(static_cast<double>(slope));
    const WideVec P = path.org + nearest * path.dir;
    // The own places of the mirrors, and of the ray's start, are each off by a rounding, and the
    // ray begins off its mirror by what RayRules::start_error says.
    const double lift = path.left < 0 ? 0.0 : 64.0 * size_of(path.org);
    const double places = size_of(path.org) + size_of(P) + t + 10.0 + lift;
    path.place_error = (path.place_error + path.turn_error * t + places) / cosine;
    const bool told =
        second == 0 || static_cast<double>(second - nearest) > 8.0 * roundoff * path.place_error;
    path.turn_error += 2.0 * curvature * path.place_error + 8.0;
    path.org = P;
    path.dir = path.dir - 2 * slope * normal;
    path.left = object;
    return told && object >= 0 && path.place_error * roundoff < 1e-2;
}

/// A tree's rays one by one, as far as which mirror they meet can be told; returns how far off
/// the last of those is, in roundoffs.
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
StressMeasure::Ask prepared(const StressOptions& options, bool room)
{
    return ask_of_trees<Real>(
        options.seed, options.rays / sparse_trees,
        [=](StressRandom& random) { return mirror_scene<Real>(random, room); },
        evaluate_tree<Real>);
}

StressMeasure measure(const char* name, const char* what, bool room)
{
    return {name, what, [=](Precision precision, const StressOptions& options) {
                return with_packet_real(
                    precision, [&]<class Real>() { return prepared<Real>(options, room); });
            }};
}

}  // namespace

std::vector<StressMeasure> tree_measures()
{
    return {measure("mirror-room", "twelve bounces between six mirrors", true),
            measure("mirror-ball", "twelve bounces inside a mirrored ball", false)};
}

}  // namespace packtrace::lab
