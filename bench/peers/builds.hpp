#pragma once

#include <packtrace/scene.hpp>

#include <nlohmann/json.hpp>

#include <vector>

namespace packtrace::peers {

/// Seconds and bytes an object of making a scene ready for rays, Embree's two geometries and
/// packtrace, with each number of threads; medians over `repetitions`, interleaved.
[[nodiscard]] nlohmann::ordered_json measure_builds(const Scene& scene, int repetitions);

}  // namespace packtrace::peers
