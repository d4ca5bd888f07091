#pragma once

#include <cstddef>
#include <cstdint>

// One-dimensional systems, a group at a time: as many as a register has bits, system k being
// bit k % 64 of word k / 64 of every plane.
namespace packtrace::abi {

/// Bits of a surface's byte, and planes of a surface in a group: direction (set: away), then two
/// bits each (low, high; 0, 1 or 2) of reflectance, translucence and emission; the last is not
/// read.
inline constexpr int onedim_planes = 8;

/// Surfaces in a 64-bit word of bytes.
inline constexpr int onedim_tile_surfaces = 8;

/// Planes of a transfer function: for a ray R of None, Medium, All whether L is at least
/// Medium, and whether it is All.
inline constexpr int onedim_state_planes = 6;

/// A run of surfaces common to a group, nearest to the eye first.
struct OnedimRun {
    const std::uint64_t* planes = nullptr;  ///< [surfaces][onedim_planes][words]
    std::size_t surfaces = 0;
    /// The transfer function beyond the run, then before it: [onedim_state_planes][words].
    /// Zeros are the empty space behind the last surface.
    std::uint64_t* state = nullptr;
};

/// The kernels of the one-dimensional note. Arrays are 64-byte aligned.
struct OnedimTable {
    int words = 0;  ///< of a plane: a group is 64 * words systems
    /// Turns tiles of eight surfaces' bytes, [tile][system % 64][system / 64], into planes in
    /// place, [tile][surface][plane][word].
    void (*transpose)(std::uint64_t* tiles, std::size_t count) = nullptr;
    /// Carries the state across a run, from its far end to its near one.
    void (*solve)(const OnedimRun& run) = nullptr;
};

}  // namespace packtrace::abi
