#pragma once

#include "kernels/cell_bounds.hpp"

// Rays put into other cells than they came in, with where each came from.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct Regrouped {
    RayGroup<Real> rays;
    std::uint8_t from[group_rays];  ///< which ray of the group each one was
    int cells = 0;                  ///< in use
};

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

/// Calls `visit(ray)` for the active rays of `cells`.
template <class Real, class Visit>
inline void for_each_active(const RayGroup<Real>& group, std::uint32_t cells, const Visit& visit)
{
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        for (std::uint32_t left = group.active[cell]; left != 0; left &= left - 1)
            visit(cell * cell_rays + __builtin_ctz(left));
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
