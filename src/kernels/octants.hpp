#pragma once

#include "kernels/cell_bounds.hpp"

// Rays that run every way, put into cells with others of the same octant of directions: such
// cells have bounds on every axis, and their rays meet children in much the same order.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct OctantGroup {
    RayGroup<Real> rays;
    std::uint8_t from[group_rays];  ///< which ray of the group each one was
    int cells = 0;                  ///< in use
};

/// A bit an axis: the direction is negative.
template <class Real>
inline int octant_of(const RayGroup<Real>& group, int ray)
{
    return (group.dir[0][ray] < 0 ? 1 : 0) | (group.dir[1][ray] < 0 ? 2 : 0) |
           (group.dir[2][ray] < 0 ? 4 : 0);
}

template <class Real>
inline void copy_ray(RayGroup<Real>& to, int at, const RayGroup<Real>& from, int ray)
{
    for (int axis = 0; axis < 3; ++axis) {
        to.org[axis][at] = from.org[axis][ray];
        to.dir[axis][at] = from.dir[axis][ray];
    }
    to.t_min[at] = from.t_min[ray];
    to.t[at] = from.t[ray];
    to.surface[at] = from.surface[ray];
}

/// Fills the rest of a cell with copies of its first ray that are not active.
template <class Real>
inline void pad_cell(RayGroup<Real>& group, int cell, int count)
{
    for (int ray = cell * cell_rays + count; ray < (cell + 1) * cell_rays; ++ray) {
        copy_ray(group, ray, group, cell * cell_rays);
        group.t[ray] = static_cast<Real>(-__builtin_inf());
    }
    group.active[cell] = static_cast<std::uint16_t>((1u << count) - 1u);
}

/// Moves the active rays of `cells` into `octants`; returns those cells of `octants` that few rays
/// are in last. Rays that find no room stay where they are, active.
template <class Real>
inline void sort_by_octant(RayGroup<Real>& group, std::uint32_t cells, OctantGroup<Real>& octants)
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
