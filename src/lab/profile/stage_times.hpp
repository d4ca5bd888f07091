#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include <packtrace/profile.hpp>

#include "kernel_abi/observation.hpp"

// The spans of time that kernels record of themselves, and the seconds of each stage they make.
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

/// Ticks of a generation's spans.
struct SpanTicks {
    std::array<double, abi::span_count> span{};
    double refracted = 0.0;  ///< share of Span::trace that is for refracted rays, in [0, 1]

    [[nodiscard]] double total() const;
};

/// The spans of a frame's pieces (ObservedFrame), each clocked several times.
class SpanTimes {
public:
    SpanTimes(int pieces, int generations);

    /// What the next piece is recorded into.
    [[nodiscard]] abi::Observation* begin();
    /// That piece is done.
    void end(int piece);

    /// Seconds of a piece's generations: of the time the piece took in the middle.
    [[nodiscard]] std::vector<SpanTicks> seconds(int piece) const;

private:
    using Clock = std::chrono::steady_clock;

    std::vector<abi::SpanLaps> laps_;
    abi::Observation observation_;
    std::vector<std::vector<std::vector<SpanTicks>>> of_piece_;  // by piece, time and generation
    std::vector<ClockReading> readings_;                         // as each piece ended
    Clock::time_point start_ = Clock::now();
};

/// The seconds of each stage, gathered piece by piece.
class StageSeconds {
public:
    explicit StageSeconds(int generations);

    /// Divides what the spans of a piece's generations took among their parts, in the shares of
    /// those parts' own clock. `parts` has as many elements as `spans`.
    void add(const std::vector<SpanTicks>& spans, const std::vector<abi::PartLaps>& parts,
             std::uint64_t reading);

    /// Those that took any time, by generation and kind of ray.
    [[nodiscard]] std::vector<KernelStage> stages() const;

private:
    // Of a generation, by kind of ray as StageSeconds::stages() has them.
    using Generation = std::array<std::array<double, abi::part_count>, 5>;

    void add_part(std::size_t depth, std::size_t rays, std::size_t part, double refracted_share,
                  double seconds);

    std::vector<Generation> generations_;
};

}  // namespace packtrace
