#pragma once

#include <cstdint>

namespace packtrace::abi {

/// What a kernel went through for a tile, as bits: proof of what it left out.
enum Passed : std::uint32_t {
    passed_hits = 1u << 0,           ///< a camera ray met something
    passed_refined = 1u << 1,        ///< hits were refined in double
    passed_normals = 1u << 2,        ///< normals of hits were looked at
    passed_occluders = 1u << 3,      ///< occluders of a light were looked for
    passed_shadow_rays = 1u << 4,    ///< shadow rays were traced
    passed_powers = 1u << 5,         ///< powers of highlights were taken
    passed_mirrored = 1u << 6,       ///< mirrored rays were traced
    passed_refracted = 1u << 7,      ///< refracted rays were traced
    passed_glass_shadows = 1u << 8,  ///< shadows asked how much occluders let through
    passed_hierarchy = 1u << 9       ///< rays went down the hierarchy
};

}  // namespace packtrace::abi
