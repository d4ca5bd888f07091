#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "lab/soak/soak_finding.hpp"

namespace packtrace::lab {

struct SoakOptions {
    std::uint64_t seed = 1;
    std::uint64_t first = 0;              ///< number of the first scene
    std::optional<std::uint64_t> scenes;  ///< how many; not set: as many as there is time for
    double seconds = 0.0;                 ///< after so long no more are begun; 0: no end
    bool aligned = false;                 ///< scenes and rays of much that coincides (align.hpp)
    int most_findings = 10;               ///< the search ends after so many
};

/// A finding in a scene as small as it shows in.
struct SoakReport {
    std::uint64_t number = 0;  ///< of the random scene it was found in
    SoakFinding finding;
    Scene scene;
};

struct SoakCounts {
    std::uint64_t scenes = 0;
    std::uint64_t refused = 0;  ///< by the scene language, and so not traced
    int findings = 0;
};

/// Traces random scenes in every way there is and hands what is not as promised to `take`. The
/// scenes follow from seed and number alone.
[[nodiscard]] SoakCounts run_soak(const SoakOptions& options,
                                  const std::function<void(const SoakReport&)>& take);

/// Checks one scene; its pictures by one rule for self-hits, with the rays that follow from `seed`,
/// `aligned` or not.
[[nodiscard]] std::optional<SoakFinding> check_scene(const Scene& scene, SelfHits self_hits,
                                                     std::uint64_t seed, bool aligned = false);

}  // namespace packtrace::lab
