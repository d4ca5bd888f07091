#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/soak/soak_way.hpp"
#include "lab/truth/wide_truth.hpp"

namespace packtrace::lab {

/// Something that is not as it should be.
struct SoakFinding {
    std::string what;              ///< one line
    std::vector<SoakWay> ways;     ///< to trace the scene, where it shows
    std::optional<StressRay> ray;  ///< of the caller's own, else it shows in the picture
    /// What is wrong with another scene in the same ways; empty where nothing is. It throws where
    /// the scene can't be traced.
    std::function<std::string(const Scene&)> again;
};

/// Renders a scene in all ways and holds the pictures against each other and, where much does not
/// coincide, against the scalar kernel. Throws what rendering throws.
[[nodiscard]] std::optional<SoakFinding> check_pictures(const Scene& scene, SelfHits self_hits,
                                                        bool aligned);

/// Traces rays of the caller's own through a scene in all ways; holds the answers against each
/// other, and those of `exact` and of doubles likewise against 113 bits.
[[nodiscard]] std::optional<SoakFinding> check_rays(const Scene& scene, std::uint64_t seed,
                                                    bool aligned);

}  // namespace packtrace::lab
