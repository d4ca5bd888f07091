#pragma once

#include <packtrace/scene.hpp>

#include <nlohmann/json.hpp>

#include <vector>

namespace packtrace::peers {

/// Seconds and bytes per object to prepare a scene for rays, with Embree's two geometries and with
/// packtrace, for each number of threads; medians of `repetitions` builds by turns.
[[nodiscard]] nlohmann::ordered_json measure_builds(const Scene& scene, int repetitions);

}  // namespace packtrace::peers
