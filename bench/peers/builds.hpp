#pragma once

#include <vector>

#include <nlohmann/json.hpp>
#include <packtrace/scene.hpp>

namespace packtrace::peers {

/// Seconds and bytes an object of making a scene ready for rays, Embree's two geometries and
/// packtrace, with each number of threads; medians over `repetitions`, interleaved.
[[nodiscard]] nlohmann::ordered_json measure_builds(const Scene& scene, int repetitions);

}  // namespace packtrace::peers
