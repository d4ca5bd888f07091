#pragma once

#include "kernel_abi/observation.hpp"
#include <packtrace/profile.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

// The times of stages that kernels record of themselves, and the seconds of each of their steps.
namespace packtrace {

/// The same moment by the processor's counter and by the clock; the second may be read late, when
/// other programs got in between.
struct ClockReading {
    std::uint64_t tick = 0;
    double seconds = 0.0;
};

/// Seconds a tick, of at least two readings in the order they were taken: the median of the
/// slopes between each reading and the one half the readings later, which a few late ones do not
/// move. Sen, Estimates of the Regression Coefficient Based on Kendall's Tau, 1968.
[[nodiscard]] double seconds_of_tick(const std::vector<ClockReading>& readings);

/// Ticks of a generation's stages.
struct GenerationTimes {
    std::array<double, abi::stage_count> stage{};
    double refracted = 0.0;  ///< share of Stage::trace that is for refracted rays, in [0, 1]

    [[nodiscard]] double total() const;
};

/// The stages of a frame's pieces (ObservedFrame), each clocked several times.
class StageTimes {
public:
    StageTimes(int pieces, int generations);

    /// What the next piece is recorded into.
    [[nodiscard]] abi::Observation* begin();
    /// That piece is done.
    void end(int piece);

    /// Seconds of a piece's generations: of the time the piece took in the middle.
    [[nodiscard]] std::vector<GenerationTimes> seconds(int piece) const;

private:
    using Clock = std::chrono::steady_clock;

    std::vector<abi::StageTicks> ticks_;
    abi::Observation observation_;
    std::vector<std::vector<std::vector<GenerationTimes>>>
        of_piece_;                        // by piece, time and generation
    std::vector<ClockReading> readings_;  // as each piece ended
    Clock::time_point start_ = Clock::now();
};

/// The seconds of each stage, gathered piece by piece.
class StageSeconds {
public:
    explicit StageSeconds(int generations);

    /// Divides what the stages of a piece's generations took among their steps, in the shares of
    /// those steps' own clock. `steps` has as many elements as `stages`.
    void add(const std::vector<GenerationTimes>& stages, const std::vector<abi::StepTicks>& steps,
             std::uint64_t reading);

    /// Those that took any time, by generation and kind of ray.
    [[nodiscard]] std::vector<KernelStage> stages() const;

private:
    // Of a generation, by kind of ray as StageSeconds::stages() has them.
    using Generation = std::array<std::array<double, abi::step_count>, 5>;

    void add_step(std::size_t depth, std::size_t rays, std::size_t step, double refracted_share,
                  double seconds);

    std::vector<Generation> generations_;
};

}  // namespace packtrace
