#pragma once

#include "kernels/regroup.hpp"

// Rays that run every way, put into cells with others of the same octant of directions: such
// cells have bounds on every axis, and their rays meet children in much the same order.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A bit an axis: the direction is negative.
template <class Real>
inline int octant_of(const RayGroup<Real>& group, int ray)
{
    return (group.dir[0][ray] < 0 ? 1 : 0) | (group.dir[1][ray] < 0 ? 2 : 0) |
           (group.dir[2][ray] < 0 ? 4 : 0);
}

/// Moves the active rays of `cells` into `octants`. Rays that find no room stay where they are,
/// active.
template <class Real>
inline void sort_by_octant(RayGroup<Real>& group, std::uint32_t cells, Regrouped<Real>& octants)
{
    int cell_of[8];
    int used[8];
    for (int octant = 0; octant < 8; ++octant)
        used[octant] = cell_rays;
    octants.cells = 0;
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        for (std::uint32_t left = group.active[cell]; left != 0; left &= left - 1) {
            const int ray = cell * cell_rays + __builtin_ctz(left);
            const int octant = octant_of(group, ray);
            if (used[octant] == cell_rays) {
                if (octants.cells == group_cells)
                    continue;
                cell_of[octant] = octants.cells++;
                used[octant] = 0;
            }
            const int at = cell_of[octant] * cell_rays + used[octant]++;
            copy_ray(octants.rays, at, group, ray);
            octants.from[at] = static_cast<std::uint8_t>(ray);
            group.active[cell] &= static_cast<std::uint16_t>(~(1u << ray % cell_rays));
            octants.rays.active[cell_of[octant]] = 0xffff;
        }
    }
    for (int octant = 0; octant < 8; ++octant)
        if (used[octant] < cell_rays)
            pad_cell(octants.rays, cell_of[octant], used[octant]);
    for (int cell = octants.cells; cell < group_cells; ++cell)
        octants.rays.active[cell] = 0;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
