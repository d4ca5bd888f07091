#pragma once

#include <cstdint>

namespace packtrace::abi {

inline constexpr int light_block_width = 16;

/// Spheres side by side, as many as the widest packet has lanes. Unused slots have a negative
/// radius, so that no ray hits them.
struct alignas(64) LightBlock {
    float center[3][light_block_width];
    float radius[light_block_width];
    std::int32_t surface[light_block_width];
};

/// The spheres that rays through one cell may hit: `count` blocks from `first` on.
struct LightCell {
    std::int32_t first = 0;
    std::int32_t count = 0;
    /// Every point whose depth is not behind this is lit, as no sphere begins before it. Depth is
    /// the squared distance from a point light; for parallel light it is the distance ahead of
    /// `origin`.
    float near = 0;
    /// No point behind this depth is lit, as a sphere that fills the cell ends before it.
    float dark = 0;
};

/// The spheres of a BVH as seen from a light, in a square grid of cells across the view (E. Haines
/// and D. Greenberg, "The Light Buffer: A Shadow-Testing Accelerator", IEEE Computer Graphics and
/// Applications 6(9), 1986). For a point light, the direction d has the grid position (across·d,
/// up·d) / forward·d + size / 2, in cells. For parallel light, the point at d from `origin` has the
/// position (across·d, up·d) + size / 2. Cells omit the spheres behind a sphere that fills them.
struct LightBuffer {
    float across[3] = {};
    float up[3] = {};
    float forward[3] = {};
    bool parallel = false;  ///< the light comes from a direction
    float origin[3] = {};   ///< for parallel light: on the light's side of all spheres
    /// For parallel light: rounding does not matter while |x| + |y| + |z| of d is at most this.
    float reach = 0;
    int size = 0;                      ///< cells in a row and in a column
    const LightCell* cells = nullptr;  ///< row by row; null: the light has no such grid
    const LightBlock* blocks = nullptr;
};

}  // namespace packtrace::abi
