#include "lab/profile/stage_times.hpp"

#include "core/seconds_since.hpp"
#include "lab/harness/statistics.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace packtrace {
namespace {

GenerationTimes times_of(const abi::StageTicks& ticks)
{
    GenerationTimes result;
    for (int i = 0; i < abi::stage_count; ++i)
        result.stage[static_cast<std::size_t>(i)] = static_cast<double>(ticks.stage[i]);
    const double traced = result.stage[static_cast<std::size_t>(abi::Stage::trace)];
    result.refracted = traced > 0.0 ? ticks.refracted / traced : 0.0;
    return result;
}

double total_of(const std::vector<GenerationTimes>& generations)
{
    double sum = 0.0;
    for (const GenerationTimes& generation : generations)
        sum += generation.total();
    return sum;
}

}  // namespace

double GenerationTimes::total() const
{
    return std::accumulate(stage.begin(), stage.end(), 0.0);
}

StageTimes::StageTimes(int pieces, int generations)
    : ticks_(static_cast<std::size_t>(generations)), of_piece_(static_cast<std::size_t>(pieces))
{
    observation_.generations = generations;
    observation_.stages = ticks_.data();
}

abi::Observation* StageTimes::begin()
{
    std::fill(ticks_.begin(), ticks_.end(), abi::StageTicks{});
    return &observation_;
}

void StageTimes::end(int piece)
{
    readings_.push_back({observation_.end, seconds_since(start_)});
    std::vector<GenerationTimes> generations;
    for (const abi::StageTicks& ticks : ticks_)
        generations.push_back(times_of(ticks));
    of_piece_[static_cast<std::size_t>(piece)].push_back(std::move(generations));
}

std::vector<GenerationTimes> StageTimes::seconds(int piece) const
{
    auto times = of_piece_[static_cast<std::size_t>(piece)];
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end(),
                     [](const auto& a, const auto& b) { return total_of(a) < total_of(b); });
    std::vector<GenerationTimes> result = *middle;
    const double seconds = seconds_of_tick(readings_);
    for (GenerationTimes& generation : result)
        for (double& stage : generation.stage)
            stage *= seconds;
    return result;
}

double seconds_of_tick(const std::vector<ClockReading>& readings)
{
    const std::size_t half = readings.size() / 2;
    std::vector<double> slopes;
    for (std::size_t i = 0; i + half < readings.size(); ++i) {
        const ClockReading& from = readings[i];
        const ClockReading& to = readings[i + half];
        if (to.tick > from.tick)
            slopes.push_back((to.seconds - from.seconds) /
                             static_cast<double>(to.tick - from.tick));
    }
    return slopes.empty() ? 0.0 : median_of(slopes);
}

namespace {

// The kind of ray that work is for, in the order of printing.
enum Rays : std::size_t { camera, reflected, refracted, shadow, hits, rays_count };

constexpr const char* rays_names[] = {"camera", "reflected", "refracted", "shadow", "hits"};

constexpr const char* step_names[] = {
    "cones and what they may meet",
    "ray generation",
    "traversal of boxes",
    "spheres",
    "anchored spheres",
    "planes",
    "quadrics",
    "polygons",
    "unsure rays again in double",
    "compaction of hits",
    "normals and materials",
    "diffuse light",
    "highlight powers",
    "child rays",
    "pixels",
};
static_assert(std::size(step_names) == abi::step_count);

// The kind of ray that a stage is for; `camera` also stands for secondary rays (see add_step()).
Rays rays_of(abi::Stage stage, abi::RayPurpose purpose)
{
    if (purpose == abi::RayPurpose::shadow || stage == abi::Stage::shadows)
        return shadow;
    return stage == abi::Stage::setup || stage == abi::Stage::trace ? camera : hits;
}

// Ticks without those of reading the clock. Reading waits for all work before it, so that its ticks
// are its own.
double without_readings(const abi::Ticks& step_ticks, std::uint64_t reading)
{
    return std::max(0.0, static_cast<double>(step_ticks.ticks) -
                             static_cast<double>(step_ticks.reads * reading));
}

double total_of(const abi::StepTicks& ticks, int stage, std::uint64_t reading)
{
    double sum = 0.0;
    for (const auto& purpose : ticks.step[stage])
        for (const abi::Ticks& step_ticks : purpose)
            sum += without_readings(step_ticks, reading);
    return sum;
}

}  // namespace

StageSeconds::StageSeconds(int generations) : generations_(static_cast<std::size_t>(generations))
{
}

void StageSeconds::add(const std::vector<GenerationTimes>& stages,
                       const std::vector<abi::StepTicks>& steps, std::uint64_t reading)
{
    for (std::size_t depth = 0; depth < generations_.size(); ++depth)
        for (int stage = 0; stage < abi::stage_count; ++stage) {
            // If a stage is too short for the clock, its steps' ticks are used as they are.
            const bool is_clocked = total_of(steps[depth], stage, reading) > 0.0;
            const std::uint64_t taken_off = is_clocked ? reading : 0;
            const double total = total_of(steps[depth], stage, taken_off);
            if (total <= 0.0)
                continue;
            const double scale = stages[depth].stage[static_cast<std::size_t>(stage)] / total;
            for (int purpose = 0; purpose < abi::purpose_count; ++purpose)
                for (int step = 0; step < abi::step_count; ++step)
                    add_step(depth,
                             rays_of(static_cast<abi::Stage>(stage),
                                     static_cast<abi::RayPurpose>(purpose)),
                             static_cast<std::size_t>(step), stages[depth].refracted,
                             scale * without_readings(steps[depth].step[stage][purpose][step],
                                                      taken_off));
        }
}

// After the first generation `camera` stands for reflected and refracted rays.
void StageSeconds::add_step(std::size_t depth, std::size_t rays, std::size_t step,
                            double refracted_share, double seconds)
{
    if (rays != camera || depth == 0) {
        generations_[depth][rays][step] += seconds;
        return;
    }
    generations_[depth][refracted][step] += seconds * refracted_share;
    generations_[depth][reflected][step] += seconds * (1.0 - refracted_share);
}

std::vector<KernelStage> StageSeconds::stages() const
{
    std::vector<KernelStage> result;
    for (std::size_t depth = 0; depth < generations_.size(); ++depth)
        for (std::size_t rays = 0; rays < rays_count; ++rays)
            for (std::size_t step = 0; step < abi::step_count; ++step)
                if (const double seconds = generations_[depth][rays][step]; seconds > 0.0)
                    result.push_back(
                        {static_cast<int>(depth), rays_names[rays], step_names[step], seconds});
    return result;
}

}  // namespace packtrace
