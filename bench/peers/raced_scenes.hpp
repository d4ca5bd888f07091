#pragma once

#include <packtrace/scene.hpp>

#include <string>
#include <vector>

namespace packtrace::peers {

/// The names of the scenes to race on: four_spheres, flake4, flake6, random1m. All have spheres
/// only.
[[nodiscard]] const std::vector<std::string>& scene_names();
/// Makes the scene of a name. Throws std::invalid_argument for another name.
[[nodiscard]] Scene raced_scene(const std::string& name, int size);

}  // namespace packtrace::peers
