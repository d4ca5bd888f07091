#pragma once

#include <cstdint>

namespace packtrace::abi {

/// Which parts of a kernel ran for a tile, as bits. Tests check by them which parts were skipped.
enum Passed : std::uint32_t {
    passed_hits = 1u << 0,           ///< a camera ray hit something
    passed_refined = 1u << 1,        ///< hits were refined in double
    passed_normals = 1u << 2,        ///< normals of hits were computed
    passed_occluders = 1u << 3,      ///< occluders of a light were searched for
    passed_shadow_rays = 1u << 4,    ///< shadow rays were traced
    passed_powers = 1u << 5,         ///< powers of highlights were computed
    passed_mirrored = 1u << 6,       ///< reflected rays were traced
    passed_refracted = 1u << 7,      ///< refracted rays were traced
    passed_glass_shadows = 1u << 8,  ///< shadow rays computed how much light occluders transmit
    passed_hierarchy = 1u << 9       ///< rays traversed the BVH
};

}  // namespace packtrace::abi
