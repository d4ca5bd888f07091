#pragma once

#include <packtrace/scene.hpp>

#include <string>
#include <vector>

namespace packtrace::peers {

/// Names of the scenes to race on, and how to make one: four_spheres, flake4, flake6, random1m.
/// All are of spheres only.
[[nodiscard]] const std::vector<std::string>& scene_names();
/// Throws std::invalid_argument for another name.
[[nodiscard]] Scene raced_scene(const std::string& name, int size);

}  // namespace packtrace::peers
