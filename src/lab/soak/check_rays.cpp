#include "lab/soak/soak.hpp"
#include "lab/soak/soak_scene.hpp"
#include "lab/stress/evaluate.hpp"
#include "lab/stress/stress_family.hpp"
#include "render/precision.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

// The promises about answers to rays: the same bits in every way of a group; and from `exact`
// packets and packets of doubles, the right answer wherever double can decide.
namespace packtrace::lab {
namespace {

constexpr int rays_of_a_scene = 48;

/// Scenes of more objects get fewer rays, because their truth takes long.
constexpr int rays_among_many = 8;
constexpr std::size_t many_objects = 30;

/// A random ray from the camera, from a surface or from anywhere. `step` is that of the grid on
/// which both ends lie; 0 for none.
StressRay any_ray(StressRandom& random, const Scene& scene, double step)
{
    const auto any_point = [&] {
        if (scene.objects.empty())
            return random.unit();
        const int count = static_cast<int>(scene.objects.size());
        return point_near(random, scene.objects[static_cast<std::size_t>(random.below(count))]);
    };
    Vec3 aim = any_point();
    Vec3 org = random.below(2) == 0 ? scene.camera.position : any_point();
    if (random.below(3) == 0) {
        const Vec3 direction = random.unit();
        org += glm::length(aim - org) * random.power(1e-3, 10.0) * direction;
    }
    if (step > 0.0) {
        aim = on_grid(aim, step);
        org = on_grid(org, step);
    }
    StressRay ray = ray_towards(org, aim);
    if (random.below(4) == 0)
        ray.dir *= random.power(1e-3, 1e3);
    if (random.below(6) == 0)
        ray.dir[random.below(3)] = 0.0;
    ray.t_min = 0.0;
    ray.t_max = random.below(4) == 0 ? glm::length(aim - org) * random.between(0.5, 1.5) : no_end;
    // Some rays aim at their own origin.
    if (!(glm::length(ray.dir) > 0.0) || !std::isfinite(glm::length(ray.dir)))
        ray.dir = random.unit();
    return ray;
}

template <class Real>
StressGroup group_of(Scene scene, std::vector<StressRay> rays)
{
    round_to_precision<Real>(scene);
    StressGroup group = stress_group(std::move(scene));
    for (StressRay& ray : rays) {
        round_to_precision<Real>(ray);
        group.expected.push_back(expect(ray, group.hits_of(ray), roundoff_of<Real>));
    }
    group.rays = std::move(rays);
    return group;
}

template <class Real>
StressRun run_way(const SoakWay& way, const StressGroup& group)
{
    const StressSubject subject{
        .kernel = "packet", .isa = way.options.isa, .exact = true, .options = way.options};
    return run_subject<Real>(subject, group);
}

/// Whether two ways gave the same answers to a ray, except for the number of hits.
bool same_first_hit(const StressRun& a, const StressRun& b, std::size_t i)
{
    StressRun one;
    StressRun other;
    one.answers = {a.answers[i]};
    other.answers = {b.answers[i]};
    return same_answers(one, other) && a.occluded[i] == b.occluded[i] && a.first[i] == b.first[i];
}

/// The true number of hits of a ray.
std::size_t true_crossings(const StressGroup& group, const StressRay& ray)
{
    std::vector<TrueHit> hits;
    for (const WideSurface& surface : group.surfaces)
        find_true_hits(surface, ray, hits);
    return static_cast<std::size_t>(
        std::count_if(hits.begin(), hits.end(), [](const TrueHit& hit) { return hit.exists; }));
}

/// What is wrong with the answer to a ray, wherever double can decide; empty for nothing.
template <class Real>
std::string fault_in(const StressGroup& group, const StressRun& run, std::size_t i)
{
    // Where double does not decide, packets of doubles may be a few last places off.
    if (sizeof(Real) == sizeof(double) && !group.expected[i].decided(double_band))
        return "";
    Evaluation evaluation(roundoff_of<Real>);
    evaluate_ray(evaluation, group, run, i);
    Errors errors = evaluation.errors();
    // One normal in 100 may be off. Hits in double are not refined, so t may be off as well.
    errors.normal_beyond = 0;
    if (sizeof(Real) == sizeof(double))
        errors.t_beyond = 0;
    const char* const fault = fault_of(errors);
    return *fault == '\0' ? "" : example_text(group, 0, i, run.answers[i], fault);
}

/// Whether a ray's answer must be the same in all ways. In `fast` mode boxes hold only hits that
/// single precision can place; false hits of bodies smaller than its rounding may differ.
template <class Real>
bool counts(const SoakWay& way, const StressGroup& group, const StressRun& run, std::size_t i)
{
    if (way.precision == Precision::double_ || way.options.accuracy == Accuracy::exact)
        return true;
    const double roundoff = roundoff_of<Real>;
    const Expected& expected = group.expected[i];
    return expected.decided(undecided_band * roundoff) &&
           verdict_of(expected, run.answers[i], undecided_band * roundoff, roundoff) ==
               Verdict::right;
}

/// Whether a ray runs along a polygon. Then rounding in double may move its hit by more than
/// rounding a point to single precision, out of the polygon's box: a list may give a hit that a BVH
/// has not.
bool runs_along_polygon(const StressGroup& group, const StressRay& ray)
{
    const double length = glm::length(ray.dir);
    for (const WideSurface& surface : group.surfaces) {
        if (surface.edges.empty())
            continue;
        std::vector<TrueHit> hits;
        find_true_hits(surface, ray, hits);
        if (hits.empty())
            return true;
        const double distance = std::abs(static_cast<double>(hits.front().t)) * length;
        if (double_band * hits.front().spread * length >
            roundoff_of<float> * (glm::length(ray.org) + distance))
            return true;
    }
    return false;
}

/// Whether the answers to a ray, `run` by way `first` and `other` by way `second`, differ where
/// they must not. The number of hits counts only if that of `first` is right.
template <class Real>
bool differs(const SoakWay& first, const SoakWay& second, const StressGroup& group,
             const StressRun& run, const StressRun& other, std::size_t i)
{
    const bool same_hit = same_first_hit(run, other, i);
    if ((same_hit && run.crossings[i] == other.crossings[i]) || !counts<Real>(first, group, run, i))
        return false;
    if (first.options.traversal != second.options.traversal &&
        runs_along_polygon(group, group.rays[i]))
        return false;
    const bool decided =
        first.precision == Precision::double_ || first.options.accuracy == Accuracy::exact;
    return !same_hit || decided || run.crossings[i] == true_crossings(group, group.rays[i]);
}

template <class Real>
SoakFinding two_ways(const StressRay& ray, const SoakWay& first, const SoakWay& second)
{
    const auto again = [ray, first, second](const Scene& scene) -> std::string {
        const StressGroup group = group_of<Real>(scene, {ray});
        const bool different = differs<Real>(first, second, group, run_way<Real>(first, group),
                                             run_way<Real>(second, group), 0);
        return different ? "answers to a ray differ" : "";
    };
    return {"answers to a ray differ", {first, second}, ray, again};
}

template <class Real>
SoakFinding one_way(std::string what, const StressRay& ray, const SoakWay& way)
{
    const auto again = [ray, way](const Scene& scene) {
        const StressGroup group = group_of<Real>(scene, {ray});
        return fault_in<Real>(group, run_way<Real>(way, group), 0);
    };
    return {std::move(what), {way}, ray, again};
}

template <class Real>
std::optional<SoakFinding> check_group(const StressGroup& group, const SoakGroup& ways,
                                       bool aligned)
{
    const SoakWay& first = ways.ways.front();
    const StressRun run = run_way<Real>(first, group);
    const bool must_be_right = first.options.accuracy == Accuracy::exact && !aligned;
    for (std::size_t i = 0; i < group.rays.size() && must_be_right; ++i)
        if (std::string what = fault_in<Real>(group, run, i); !what.empty())
            return one_way<Real>(std::move(what), group.rays[i], first);
    for (const SoakWay& way : ways.ways) {
        // A caller's own rays have one kernel only.
        if (way.options.force_general)
            continue;
        const StressRun other = run_way<Real>(way, group);
        for (std::size_t i = 0; i < group.rays.size(); ++i)
            if (differs<Real>(first, way, group, run, other, i))
                return two_ways<Real>(group.rays[i], first, way);
    }
    return std::nullopt;
}

template <class Real>
std::optional<SoakFinding> check_precision(const Scene& scene, const std::vector<StressRay>& rays,
                                           bool aligned)
{
    const StressGroup group = group_of<Real>(scene, rays);
    for (const Accuracy accuracy : {Accuracy::exact, Accuracy::fast}) {
        // In double both are the same.
        if (precision_of<Real> == Precision::double_ && accuracy == Accuracy::fast)
            continue;
        for (const SoakGroup& ways : packet_groups(precision_of<Real>, accuracy, SelfHits::exact))
            if (auto finding = check_group<Real>(group, ways, aligned))
                return finding;
    }
    return std::nullopt;
}

}  // namespace

std::optional<SoakFinding> check_rays(const Scene& scene, std::uint64_t seed, bool aligned)
{
    StressRandom random(seed);
    const int count = scene.objects.size() > many_objects ? rays_among_many : rays_of_a_scene;
    std::vector<StressRay> rays;
    for (int i = 0; i < count; ++i)
        rays.push_back(any_ray(random, scene, aligned ? grid_step(scene) : 0.0));
    if (auto finding = check_precision<float>(scene, rays, aligned))
        return finding;
    return check_precision<double>(scene, rays, aligned);
}

}  // namespace packtrace::lab
