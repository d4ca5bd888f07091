#pragma once

#include <cstdint>

namespace packtrace::abi {

/// What a kernel went through for a tile, as bits: proof of what it left out.
enum Stage : std::uint32_t {
    stage_hits = 1u << 0,           ///< a camera ray met something
    stage_refined = 1u << 1,        ///< hits were refined in double
    stage_normals = 1u << 2,        ///< normals of hits were looked at
    stage_blockers = 1u << 3,       ///< blockers of a light were looked for
    stage_shadow_rays = 1u << 4,    ///< shadow rays were traced
    stage_powers = 1u << 5,         ///< powers of highlights were taken
    stage_mirrored = 1u << 6,       ///< mirrored rays were traced
    stage_refracted = 1u << 7,      ///< refracted rays were traced
    stage_glass_shadows = 1u << 8,  ///< shadows asked how much blockers let through
    stage_hierarchy = 1u << 9       ///< rays went down the hierarchy
};

}  // namespace packtrace::abi
