#pragma once

#include <packtrace/rays.hpp>

// Parts of the arrays that a caller gives.
namespace packtrace {

/// Null stays null.
template <class T>
T* part_of(T* array, std::size_t first)
{
    return array == nullptr ? nullptr : array + first;
}

template <class Real>
RaysView<Real> part_of(const RaysView<Real>& rays, std::size_t first, std::size_t count)
{
    return {rays.org_x + first, rays.org_y + first, rays.org_z + first,
            rays.dir_x + first, rays.dir_y + first, rays.dir_z + first,
            rays.t_min + first, rays.t_max + first, count};
}

template <class Real>
HitsView<Real> part_of(const HitsView<Real>& hits, std::size_t first)
{
    HitsView<Real> part;
    part.t = hits.t + first;
    part.object = hits.object + first;
    part.normal_x = part_of(hits.normal_x, first);
    part.normal_y = part_of(hits.normal_y, first);
    part.normal_z = part_of(hits.normal_z, first);
    for (int axis = 0; axis < 3; ++axis) {
        part.outer_start[axis] = part_of(hits.outer_start[axis], first);
        part.inner_start[axis] = part_of(hits.inner_start[axis], first);
        part.point[axis] = part_of(hits.point[axis], first);
    }
    part.surface = part_of(hits.surface, first);
    return part;
}

template <class Real>
StartsView<Real> part_of(const StartsView<Real>& starts, std::size_t first)
{
    return {{starts.point[0] + first, starts.point[1] + first, starts.point[2] + first},
            starts.surface + first};
}

template <class Real>
PointsView<Real> part_of(const PointsView<Real>& points, std::size_t first, std::size_t count)
{
    return {{points.point[0] + first, points.point[1] + first, points.point[2] + first},
            part_of(points.surface, first),
            count};
}

}  // namespace packtrace
