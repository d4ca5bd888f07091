#pragma once

#include <cstdint>
#include <vector>

#include "lab/stress/stress_subject.hpp"

namespace packtrace::lab {

/// Rays that leave hits, and what they hit next.
struct SecondHits {
    std::uint64_t rays = 0;
    std::uint64_t taken = 0;  ///< hits of the own surface at the start, or where there is none
    /// Second hits not found, or found a tenth or more off; by the notes' rule only those by
    /// chords four times deeper than the hit point is off.
    std::uint64_t lost = 0;
    /// Relative errors of t where the own surface is hit again.
    std::vector<float> errors;
    /// Those beyond 1e-6 and what the inputs' rounding makes of t in double.
    std::uint64_t inexact = 0;

    void add(const SecondHits& other);
};

/// For packets; of groups with crossing planes nothing is counted.
template <class Real>
[[nodiscard]] SecondHits trace_second_hits(const StressSubject& subject, const StressGroup& group,
                                           SelfHits rule);

}  // namespace packtrace::lab
