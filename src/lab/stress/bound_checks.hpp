#pragma once

#include <cstdint>
#include <vector>

#include "lab/stress/stress_subject.hpp"

namespace packtrace::lab {

/// Proven bounds of hits, held against the truth.
struct BoundChecks {
    std::uint64_t bounds = 0;  ///< of hits that there truly are
    std::uint64_t missed = 0;  ///< that do not hold the true t
    std::vector<float> ulp;    ///< how far apart they are, in last places of double

    void add(const BoundChecks& other);
};

/// Bounds of the closest hits of a group's rays, and of all hits.
template <class Real>
[[nodiscard]] BoundChecks check_bounds(const StressSubject& subject, const StressGroup& group);

}  // namespace packtrace::lab
