#pragma once

#include <string>
#include <vector>

#include <packtrace/scene.hpp>

namespace packtrace::peers {

/// Names of the scenes to race on, and how to make one: four_spheres, flake4, flake6, random1m.
/// All are of spheres only.
[[nodiscard]] const std::vector<std::string>& scene_names();
/// Throws std::invalid_argument for another name.
[[nodiscard]] Scene raced_scene(const std::string& name, int size);

}  // namespace packtrace::peers
