#pragma once

#include <cstddef>
#include <cstdint>

// One-dimensional systems are solved in groups. A group has as many systems as a register has bits:
// system k is bit k % 64 of word k / 64 of every plane.
namespace packtrace::abi {

/// Bits of a surface's byte, and planes of a surface in a group: direction (1: away), then two bits
/// each (low, high; value 0, 1 or 2) of reflectance, translucence and emission. The last bit is not
/// read.
inline constexpr int onedim_planes = 8;

/// Surfaces in a 64-bit word of bytes.
inline constexpr int onedim_tile_surfaces = 8;

/// Planes of a transfer function: for incoming light R of None, Medium and All, whether L is at
/// least Medium, and whether L is All.
inline constexpr int onedim_state_planes = 6;

/// A run of surfaces that all systems of a group have, nearest to the eye first.
struct OnedimRun {
    const std::uint64_t* planes = nullptr;  ///< [surfaces][onedim_planes][words]
    std::size_t surfaces = 0;
    /// In: the transfer function of what is behind the run. Out: the same including the run.
    /// [onedim_state_planes][words]. Zeros are the empty space behind the last surface.
    std::uint64_t* state = nullptr;
};

/// The kernels of the one-dimensional note. Arrays are 64-byte aligned.
struct OnedimTable {
    int words = 0;  ///< words per plane; a group has 64 * words systems
    /// Transposes tiles of eight surfaces' bytes, [tile][system % 64][system / 64], into planes, in
    /// place: [tile][surface][plane][word].
    void (*transpose)(std::uint64_t* tiles, std::size_t count) = nullptr;
    /// Carries the state through a run, from its far end to its near end.
    void (*solve)(const OnedimRun& run) = nullptr;
};

}  // namespace packtrace::abi
