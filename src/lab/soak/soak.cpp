#include "lab/soak/soak.hpp"

#include "core/seconds_since.hpp"
#include "lab/soak/soak_scene.hpp"
#include "lab/stress/stress_family.hpp"
#include <packtrace/read_scene.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace packtrace::lab {
namespace {

/// Scenes that are checked in parallel, between two looks at the time.
constexpr std::uint64_t batch = 32;

/// One scene in so many is checked by the notes' rule for self-hits, which is there for comparison.
constexpr std::uint64_t scenes_by_note = 5;

/// The result for a scene.
struct Outcome {
    bool refused = false;
    std::optional<SoakFinding> finding;
    Scene scene;
};

/// The seed of a scene's random numbers.
std::uint64_t seed_of(std::uint64_t seed, std::uint64_t number)
{
    return StressRandom(StressRandom(seed).bits() ^ number).bits();
}

Outcome outcome_of(std::uint64_t seed, bool aligned)
{
    StressRandom random(seed);
    Scene made = soak_scene(random);
    if (aligned)
        align(made);
    Outcome outcome;
    try {
        outcome.scene = as_read(made);
        const std::uint64_t rays = random.bits();
        const SelfHits self_hits = rays % scenes_by_note == 0 ? SelfHits::note : SelfHits::exact;
        outcome.finding = check_scene(outcome.scene, self_hits, rays, aligned);
    } catch (const SceneError&) {
        outcome.refused = true;
    } catch (const std::invalid_argument&) {
        outcome.refused = true;
    }
    return outcome;
}

/// The limits of a search.
class Limit {
public:
    explicit Limit(const SoakOptions& options) : options_(options), start_(Clock::now())
    {
    }
    /// The number of scenes in the next batch; 0 if no time or no scene is left.
    [[nodiscard]] std::uint64_t next(std::uint64_t done) const
    {
        if (options_.seconds > 0.0 && seconds_since(start_) >= options_.seconds)
            return 0;
        return options_.scenes ? std::min(batch, *options_.scenes - done) : batch;
    }

private:
    using Clock = std::chrono::steady_clock;
    const SoakOptions& options_;
    Clock::time_point start_;
};

SoakReport report_of(std::uint64_t number, Outcome outcome)
{
    SoakReport report{number, *std::move(outcome.finding), {}};
    report.scene = shrink(report.finding, std::move(outcome.scene));
    // The truth of rays is that of the rounded scene.
    if (report.finding.ray && report.finding.ways.front().precision == Precision::single)
        round_to_precision<float>(report.scene);
    return report;
}

}  // namespace

std::optional<SoakFinding> check_scene(const Scene& scene, SelfHits self_hits, std::uint64_t seed,
                                       bool aligned)
{
    if (auto finding = check_pictures(scene, self_hits, aligned))
        return finding;
    return check_rays(scene, seed, aligned);
}

SoakCounts run_soak(const SoakOptions& options, const std::function<void(const SoakReport&)>& take,
                    const std::function<void(const SoakCounts&)>& tell)
{
    SoakCounts counts;
    const Limit limit(options);
    while (const std::uint64_t count = limit.next(counts.scenes)) {
        if (tell)
            tell(counts);
        const std::uint64_t first = options.first + counts.scenes;
        std::vector<Outcome> outcomes(count);
        tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t i) {
            outcomes[i] = outcome_of(seed_of(options.seed, first + i), options.aligned);
        });
        for (std::uint64_t i = 0; i < count; ++i) {
            ++counts.scenes;
            counts.refused += std::uint64_t{outcomes[i].refused};
            if (!outcomes[i].finding)
                continue;
            take(report_of(first + i, std::move(outcomes[i])));
            if (++counts.findings >= options.most_findings)
                return counts;
        }
    }
    return counts;
}

}  // namespace packtrace::lab
