#pragma once

#include "dispatch/kernels.hpp"
#include "lab/harness/ray_trees.hpp"
#include "lab/stress/evaluate.hpp"
#include "lab/stress/stress_random.hpp"
#include "lab/stress/stress_subject.hpp"
#include <packtrace/explain.hpp>

#include <functional>
#include <string>
#include <vector>

// Families that test something other than hits.
namespace packtrace::lab {

/// A kernel's answers as numbers, their errors, and its time.
struct MeasureRun {
    Errors errors;
    std::vector<double> answers;
    double seconds = 0.0;
};

/// A family that tests something other than hits. `prepare` computes the truth for one of
/// packet_precisions; the function that it returns is called for each packet kernel.
struct StressMeasure {
    std::string name;
    std::string what;
    using Ask = std::function<MeasureRun(const StressSubject&)>;
    std::function<Ask(Precision, const StressOptions&)> prepare;
};

/// All measures, in the order in which they are shown.
[[nodiscard]] std::vector<StressMeasure> stress_measures();

/// Highlights' powers.
[[nodiscard]] std::vector<StressMeasure> power_measures();
/// Total internal reflection.
[[nodiscard]] StressMeasure glass_measure();
/// Deep ray trees.
[[nodiscard]] std::vector<StressMeasure> tree_measures();

/// Pixels along each edge of the scenes of which measures take ray trees: one tile.
inline constexpr int measure_edge = 16;

/// Calls `take(tree)` with the ray trees of a scene's pixels, row by row, but of at most `most`, as
/// packets of `Real` trace them with SelfHits::exact.
template <class Real, class Take>
void for_each_tree(const Scene& scene, const StressSubject& subject, int most, const Take& take)
{
    const Accuracy accuracy =
        sizeof(Real) == sizeof(float) ? subject.options.accuracy : Accuracy::fast;
    const auto trees =
        packet_trees<Real>(scene, lower(scene, accuracy, SelfHits::exact), kernels_of(subject.isa));
    for (int pixel = 0; pixel < scene.width * scene.height && pixel < most; ++pixel)
        take(trees(pixel % scene.width, pixel / scene.width));
}

/// Calls `evaluate(scene, tree, run)` for the ray trees of scenes made by `make(random)`: about
/// `trees` trees, spread evenly over the scenes.
template <class Real, class Make, class Evaluate>
[[nodiscard]] StressMeasure::Ask ask_of_trees(std::uint64_t seed, int trees, Make make,
                                              Evaluate evaluate)
{
    constexpr int scene_count = 16;
    std::vector<Scene> scenes;
    for (int i = 0; i < scene_count; ++i) {
        StressRandom random(seed * scene_count + static_cast<std::uint64_t>(i));
        scenes.push_back(make(random));
    }
    return [=](const StressSubject& subject) {
        MeasureRun run;
        for (const Scene& scene : scenes)
            for_each_tree<Real>(scene, subject, trees / scene_count + 1,
                                [&](const RayNode& tree) { evaluate(scene, tree, run); });
        return run;
    };
}

/// A camera at `org` whose picture of measure_edge pixels a side is `spread` wide at distance 1.
[[nodiscard]] inline Camera measure_camera(const Vec3& org, const Vec3& towards, double spread)
{
    return {.position = org,
            .rotation = look_at(org, org + towards, Vec3(towards.y, towards.z, -towards.x)),
            .viewport = Vec2(spread),
            .pixel_sample = Vec2(0.5)};
}

}  // namespace packtrace::lab
