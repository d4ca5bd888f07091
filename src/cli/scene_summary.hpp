#pragma once

#include <string>
#include <utility>
#include <vector>

#include <packtrace/scene.hpp>

namespace packtrace::cli {

/// How many there are of each kind, in the order the scene language lists the kinds; kinds
/// that don't occur are left out.
using Census = std::vector<std::pair<std::string, int>>;

[[nodiscard]] Census count_objects(const Scene& scene);
[[nodiscard]] Census count_lights(const Scene& scene);

// As the scene language writes them.
[[nodiscard]] std::string name_of(Illumination illumination);
[[nodiscard]] std::string name_of(ShadowKind shadows);

}  // namespace packtrace::cli
