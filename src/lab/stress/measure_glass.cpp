#include "lab/stress/stress_family.hpp"
#include "lab/stress/stress_measure.hpp"
#include "lab/stress/stress_subject.hpp"
#include "lab/truth/wide.hpp"
#include "render/precision.hpp"

#include <glm/geometric.hpp>

#include <cmath>

// Total internal reflection: rays from inside a glass ball at the critical angle.
namespace packtrace::lab {
namespace {

using reference::dot;

/// A glass ball and a camera in it that looks to where rays hit the surface at the critical angle.
template <class Real>
Scene glass_scene(StressRandom& random)
{
    const double ior = static_cast<double>(static_cast<Real>(random.between(1.1, 2.5)));
    Object ball = sphere_object(random.box(3.0), random.between(0.5, 2.0));
    ball.material.model = GeneralMaterial{.transmit = Rgb(1.0), .ior = ior};

    Scene scene{.illumination = Illumination::general, .objects = {ball}};
    round_to_precision<Real>(scene);
    const Sphere& sphere = std::get<Sphere>(scene.objects[0].surface);
    const double off = random.between(1.0 / ior, 0.98);
    const Vec3 outwards = random.unit();
    const double sine = 1.0 / (ior * off);
    const Vec3 towards =
        random.sign() * std::sqrt(1.0 - sine * sine) * outwards + sine * across(random, outwards);
    scene.camera = measure_camera(sphere.center + off * sphere.radius * outwards, towards,
                                  random.power(1e-7, 1e-1));
    scene.width = scene.height = measure_edge;
    scene.max_depth = 1;
    return scene;
}

/// The truth about a ray at the surface.
struct Refraction {
    bool total;        ///< internal reflection
    double margin;     ///< relative change of the inputs that changes `total`
    WideVec dir;       ///< refracted, where not total
    double condition;  ///< change of `dir` for relative changes 1 of every input
};

Refraction refraction_of(const Sphere& sphere, double ior, const RayNode& ray)
{
    const WideVec o = wide(ray.org) - wide(sphere.center);
    const Wide length = square_root(dot(wide(ray.dir), wide(ray.dir)));
    const WideVec d = wide(ray.dir) / length;
    const Wide radius = sphere.radius;
    const Wide b = dot(o, d);
    const Wide t = square_root(b * b - dot(o, o) + radius * radius) - b;
    const WideVec normal = (o + t * d) / radius;
    const Wide cosine = dot(normal, d);
    const Wide eta = ior;
    const Wide out2 = 1 - eta * eta * (1 - cosine * cosine);
    // cos² changes by rounding the direction and the ior, and because the hit point moves.
    const Wide place = square_root(dot(wide(sphere.center), wide(sphere.center)));
    const Wide moved = (2 * place + square_root(dot(o, o)) + t) / radius;
    const Wide change = 2 * eta * eta * (1 - cosine * cosine + cosine + moved);
    Refraction truth;
    truth.total = out2 < 0;
    truth.margin = static_cast<double>(magnitude(out2) / change);
    if (!truth.total) {
        const Wide out = square_root(out2);
        truth.dir = eta * d + (out - eta * cosine) * normal;
        truth.condition = static_cast<double>(eta * (2 + moved) + change / (2 * out));
    }
    return truth;
}

template <class Real>
void evaluate_glass_tree(const Scene& scene, const RayNode& tree, MeasureRun& run)
{
    const double roundoff = roundoff_of<Real>;
    const Sphere& sphere = std::get<Sphere>(scene.objects[0].surface);
    const double ior = std::get<GeneralMaterial>(scene.objects[0].material.model).ior;
    const Refraction truth = refraction_of(sphere, ior, tree);
    Errors& errors = run.errors;
    ++errors.rays;
    const bool undecided = truth.margin < undecided_band * roundoff;
    errors.undecided += undecided;
    const bool one = tree.children.size() == 1;
    const bool total = one && tree.children[0].kind == RayKind::mirrored;
    run.answers.push_back(total ? 1.0 : 0.0);
    if (!one || (total != truth.total && !undecided)) {
        ++errors.beyond_own_band;
        return;
    }
    if (total || truth.total)
        return;
    ++errors.hits;
    const Vec3 dir = tree.children[0].dir;
    run.answers.insert(run.answers.end(), {dir.x, dir.y, dir.z});
    errors.not_finite += !std::isfinite(dir.x + dir.y + dir.z);
    if (undecided)
        return;
    const double error = largest(wide(dir) - truth.dir);
    errors.normal.push_back(static_cast<float>(error));
    errors.rho = std::max(errors.rho, error / (roundoff * truth.condition));
}

template <class Real>
StressMeasure::Ask prepared(const StressOptions& options)
{
    return ask_of_trees<Real>(options.seed, options.rays, glass_scene<Real>,
                              evaluate_glass_tree<Real>);
}

}  // namespace

StressMeasure glass_measure()
{
    return {"critical-angle", "out of a ball of glass at total internal reflection",
            [](Precision precision, const StressOptions& options) {
                return with_packet_real(precision,
                                        [&]<class Real>() { return prepared<Real>(options); });
            }};
}

}  // namespace packtrace::lab
