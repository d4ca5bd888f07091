#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <packtrace/scene.hpp>

#include "bounds/bounded_scene.hpp"

// Which objects an update of a RayScene is about.
namespace packtrace {

/// Throws std::invalid_argument where a scene has not as many objects as are held.
void check_same_objects(std::size_t given, std::size_t held);

/// Each number once. Throws std::invalid_argument for one that is not below `count`.
[[nodiscard]] std::vector<std::int32_t> distinct_objects(std::span<const std::int32_t> numbers,
                                                         std::size_t count);

/// The objects that are not where they were. There are as many as before.
[[nodiscard]] std::vector<std::int32_t> moved_objects(const bounds::BoundedScene& before,
                                                      const Scene& now);

}  // namespace packtrace
