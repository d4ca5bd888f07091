#pragma once

#include <cstdint>

namespace packtrace::abi {

inline constexpr int light_block_width = 16;

/// Spheres side by side: as many as the widest packet has lanes. Unused places have a negative
/// radius, which nothing hits.
struct alignas(64) LightBlock {
    float center[3][light_block_width];
    float radius[light_block_width];
    std::int32_t surface[light_block_width];
};

/// The spheres that the rays of one cell may meet: `count` blocks from `first` on.
struct LightCell {
    std::int32_t first = 0;
    std::int32_t count = 0;
    /// All is lit that is not behind this depth, as no sphere begins before it. Depths are squares
    /// of the distance from a point light, and distances ahead of `origin` of parallel light.
    float near = 0;
    float dark = 0;  ///< nothing is lit behind it, as a sphere that fills the cell ends before it
};

/// The spheres of a hierarchy as a light sees them, in a square grid of cells across its view of
/// all of them (E. Haines and D. Greenberg, "The Light Buffer: A Shadow-Testing Accelerator", IEEE
/// Computer Graphics and Applications 6(9), 1986). A direction d from a point light is seen at
/// (across·d, up·d) / forward·d + size / 2, in cells; a point at d from `origin` that parallel
/// light falls on, at (across·d, up·d) + size / 2. Cells leave out what is behind a sphere that
/// fills them.
struct LightBuffer {
    float across[3] = {};
    float up[3] = {};
    float forward[3] = {};
    bool parallel = false;  ///< the light comes from a direction
    float origin[3] = {};   ///< of parallel light, on the light's side of all spheres
    /// What |x| + |y| + |z| of d may be for rounding not to matter, for parallel light.
    float reach = 0;
    int size = 0;                      ///< cells in a row and in a column
    const LightCell* cells = nullptr;  ///< row by row; null: the light has no such grid
    const LightBlock* blocks = nullptr;
};

}  // namespace packtrace::abi
