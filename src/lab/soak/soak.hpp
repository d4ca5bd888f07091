#pragma once

#include "lab/soak/soak_way.hpp"
#include "lab/truth/wide_truth.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// The search for scenes in which something is not as promised.
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

// Its steps: check_pictures.cpp, check_rays.cpp, shrink.cpp.

/// Renders a scene in all ways and holds the pictures against each other and, where much does not
/// coincide, against the scalar kernel. Throws what rendering throws.
[[nodiscard]] std::optional<SoakFinding> check_pictures(const Scene& scene, SelfHits self_hits,
                                                        bool aligned);

/// Traces rays of the caller's own through a scene in all ways; holds the answers against each
/// other, and those of `exact` and of doubles likewise against 113 bits.
[[nodiscard]] std::optional<SoakFinding> check_rays(const Scene& scene, std::uint64_t seed,
                                                    bool aligned);

/// Checks one scene; its pictures by one rule for self-hits, with the rays that follow from `seed`,
/// `aligned` or not.
[[nodiscard]] std::optional<SoakFinding> check_scene(const Scene& scene, SelfHits self_hits,
                                                     std::uint64_t seed, bool aligned = false);

/// A scene as its file says it: what is found in it, the file shows. Throws SceneError and
/// std::invalid_argument for what the language can't say.
[[nodiscard]] Scene as_read(const Scene& scene);

/// A scene in which the finding still shows and of which nothing more can be left out: objects,
/// lights, transforms, contours, materials, depth, pixels. `finding.what` becomes what shows in it.
[[nodiscard]] Scene shrink(SoakFinding& finding, Scene scene);

// The whole search (soak.cpp).

struct SoakOptions {
    std::uint64_t seed = 1;
    std::uint64_t first = 0;              ///< number of the first scene
    std::optional<std::uint64_t> scenes;  ///< how many; not set: as many as there is time for
    double seconds = 0.0;                 ///< after so long no more are begun; 0: no end
    bool aligned = false;    ///< scenes and rays of much that coincides (soak_scene.hpp)
    int most_findings = 10;  ///< the search ends after so many
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

/// Traces random scenes in every way there is and hands what is not as promised to `take`, and how
/// far it has come to `tell` now and then. The scenes follow from seed and number alone.
[[nodiscard]] SoakCounts run_soak(const SoakOptions& options,
                                  const std::function<void(const SoakReport&)>& take,
                                  const std::function<void(const SoakCounts&)>& tell = {});

}  // namespace packtrace::lab
