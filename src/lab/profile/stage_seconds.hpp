#pragma once

#include <vector>

#include <packtrace/profile.hpp>

#include "lab/profile/span_times.hpp"

namespace packtrace {

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
