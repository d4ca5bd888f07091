#pragma once

#include "kernel_abi/observation.hpp"
#include <packtrace/profile.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

// The times of stages that kernels record, and the seconds of each of their steps.
namespace packtrace {

/// One moment by the processor's counter and by the clock. The clock may be read too late, if
/// another program runs in between.
struct ClockReading {
    std::uint64_t tick = 0;
    double seconds = 0.0;
};

/// Seconds per tick, by at least two readings in order: the median of the slopes between each
/// reading and the one half of the readings later. A few late readings do not change it. Sen,
/// Estimates of the Regression Coefficient Based on Kendall's Tau, 1968.
[[nodiscard]] double seconds_of_tick(const std::vector<ClockReading>& readings);

/// Ticks of a generation's stages.
struct GenerationTimes {
    std::array<double, abi::stage_count> stage{};
    double refracted = 0.0;  ///< share of Stage::trace that is for refracted rays, in [0, 1]

    [[nodiscard]] double total() const;
};

/// The stages of a frame's pieces (ObservedFrame), clocked several times.
class StageTimes {
public:
    StageTimes(int pieces, int generations);

    /// Begins a piece; returns what to record it into.
    [[nodiscard]] abi::Observation* begin();
    /// Ends the piece.
    void end(int piece);

    /// Seconds of a piece's generations, from the repetition with the median total.
    [[nodiscard]] std::vector<GenerationTimes> seconds(int piece) const;

private:
    using Clock = std::chrono::steady_clock;

    std::vector<abi::StageTicks> ticks_;
    abi::Observation observation_;
    // By piece, repetition and generation.
    std::vector<std::vector<std::vector<GenerationTimes>>> of_piece_;
    std::vector<ClockReading> readings_;  // at the end of each piece
    Clock::time_point start_ = Clock::now();
};

/// The seconds of each stage and step, summed over the pieces.
class StageSeconds {
public:
    explicit StageSeconds(int generations);

    /// Divides the times of a piece's stages among their steps, by the shares that the steps' own
    /// clock gives. Both vectors are by generation. `reading` is the ticks that reading the clock
    /// takes.
    void add(const std::vector<GenerationTimes>& stages, const std::vector<abi::StepTicks>& steps,
             std::uint64_t reading);

    /// The steps that took any time, by generation and kind of ray.
    [[nodiscard]] std::vector<KernelStage> stages() const;

private:
    // Of one generation, by kind of ray in the order of stages().
    using Generation = std::array<std::array<double, abi::step_count>, 5>;

    void add_step(std::size_t depth, std::size_t rays, std::size_t step, double refracted_share,
                  double seconds);

    std::vector<Generation> generations_;
};

}  // namespace packtrace
