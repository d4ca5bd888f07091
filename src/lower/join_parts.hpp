#pragma once

#include <span>

#include "lower/lowered_scene.hpp"
#include "lower/recent_materials.hpp"

namespace packtrace {

/// Appends what runs of objects lowered to, each with its surfaces, materials and checkers
/// numbered from 0, in order; `recent` knows the materials of the whole. The parts' lists are
/// empty then, but keep their memory.
void join_parts(std::span<LoweredScene> parts, RecentMaterials& recent, LoweredScene& whole);

}  // namespace packtrace
