#pragma once

#include "lab/soak/soak_way.hpp"
#include "lab/truth/wide_truth.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// The search for scenes that break a promise of the program.
namespace packtrace::lab {

/// A broken promise.
struct SoakFinding {
    std::string what;              ///< one line
    std::vector<SoakWay> ways;     ///< the ways to trace the scene in which it shows
    std::optional<StressRay> ray;  ///< the caller's own ray; none: it shows in the picture
    /// Repeats the check on another scene, in the same ways. Returns what is wrong; empty for
    /// nothing. Throws if the scene cannot be traced.
    std::function<std::string(const Scene&)> again;
};

// Its steps: check_pictures.cpp, check_rays.cpp, shrink.cpp. In an `aligned` scene many things
// coincide (soak_scene.hpp), and rounding decides much: answers are compared with each other only.

/// Renders a scene in all ways and compares the pictures with each other and with the scalar
/// kernel's. Throws what rendering throws.
[[nodiscard]] std::optional<SoakFinding> check_pictures(const Scene& scene, SelfHits self_hits,
                                                        bool aligned);

/// Traces a caller's own rays through a scene in all ways. Compares the answers with each other,
/// and those of `exact` and of doubles with the truth in 113 bits.
[[nodiscard]] std::optional<SoakFinding> check_rays(const Scene& scene, std::uint64_t seed,
                                                    bool aligned);

/// Checks the pictures of one scene, by one rule for self-hits, and rays that follow from `seed`.
[[nodiscard]] std::optional<SoakFinding> check_scene(const Scene& scene, SelfHits self_hits,
                                                     std::uint64_t seed, bool aligned = false);

/// The scene after writing and reading it, so that a finding also shows with the written file.
/// Throws SceneError and std::invalid_argument for a scene that the language cannot express.
[[nodiscard]] Scene as_read(const Scene& scene);

/// A scene in which the finding still shows and of which nothing more can be removed: objects,
/// lights, transforms, contours, materials, depth, pixels. `finding.what` becomes that of this
/// scene.
[[nodiscard]] Scene shrink(SoakFinding& finding, Scene scene);

// The whole search (soak.cpp).

struct SoakOptions {
    std::uint64_t seed = 1;
    std::uint64_t first = 0;              ///< number of the first scene
    std::optional<std::uint64_t> scenes;  ///< number of scenes; not set: no limit
    double seconds = 0.0;                 ///< no scene is begun after this time; 0: no limit
    bool aligned = false;                 ///< scenes and rays on a grid (soak_scene.hpp)
    int most_findings = 10;               ///< the search ends after this many
};

/// A finding, with the smallest scene in which it shows.
struct SoakReport {
    std::uint64_t number = 0;  ///< of the random scene in which it was found
    SoakFinding finding;
    Scene scene;
};

struct SoakCounts {
    std::uint64_t scenes = 0;
    std::uint64_t refused = 0;  ///< by the scene language; they are not traced
    int findings = 0;
};

/// Checks random scenes, which follow from seed and number alone. Passes findings to `take`, and
/// now and then the counts so far to `tell`.
[[nodiscard]] SoakCounts run_soak(const SoakOptions& options,
                                  const std::function<void(const SoakReport&)>& take,
                                  const std::function<void(const SoakCounts&)>& tell = {});

}  // namespace packtrace::lab
