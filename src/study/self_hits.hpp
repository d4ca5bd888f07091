#pragma once

#include <cstdint>

#include "study/stress_subject.hpp"

namespace packtrace::study {

/// Secondary rays from where primary ones hit, and how often their own start was taken for a hit
/// or a true second meeting with the same surface was missed.
struct SelfHitCounts {
    std::uint64_t rays = 0;
    std::uint64_t taken = 0;  ///< hits of the own surface where there is none
    /// Second meetings not found, or found a tenth or more off; by the notes' rule only those
    /// by chords four times deeper than the hit point is off.
    std::uint64_t lost = 0;

    void add(const SelfHitCounts& other);
};

/// For packets, on groups of one surface that is not clipped; else nothing is counted.
template <class Real>
[[nodiscard]] SelfHitCounts count_self_hits(const StressSubject& subject, const StressGroup& group,
                                            SelfHits rule);

}  // namespace packtrace::study
