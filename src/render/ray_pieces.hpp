#pragma once

#include "render/check_arrays.hpp"
#include <packtrace/rays.hpp>
#include <packtrace/stop.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

// Splits a caller's rays into pieces. Arrays are split into parts of arrays. Structs are copied
// into arrays for the kernels, one chunk at a time, and their hits are copied back.
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

/// Calls `work(first, count)` for all `rays`: piece by piece if the query is watched, otherwise
/// once. Throws StopError after a stop request.
template <class Work>
void for_watched_pieces(std::size_t rays, const QueryWatch& watch, const Work& work)
{
    constexpr std::size_t watched_rays = 4096;
    const bool watched = watch.stop.stop_possible() || watch.progress;
    const std::size_t longest = watched ? watched_rays : rays;
    const std::size_t step = rays / 100 + 1;
    std::size_t reported = 0;
    for (std::size_t first = 0; first < rays; first += longest) {
        if (watch.stop.stop_requested())
            throw StopError("the query was asked to stop");
        const std::size_t done = std::min(rays, first + longest);
        work(first, done - first);
        if (watch.progress && (done == rays || done - reported >= step)) {
            reported = done;
            watch.progress(static_cast<double>(done) / static_cast<double>(rays));
        }
    }
}

inline constexpr std::size_t chunk_rays = 256;

template <class Real>
class RayChunk {
public:
    RaysView<Real> fill(const RayStructs<Real>& rays, std::size_t first, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) {
            const Ray<Real>& ray = rays[first + i];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                columns_[axis][i] = ray.org[axis];
                columns_[3 + axis][i] = ray.dir[axis];
            }
            columns_[6][i] = ray.t_min;
            columns_[7][i] = ray.t_max;
        }
        return {columns_[0], columns_[1], columns_[2], columns_[3], columns_[4],
                columns_[5], columns_[6], columns_[7], count};
    }

private:
    alignas(64) Real columns_[8][chunk_rays];
};

template <class Real>
class HitChunk {
public:
    HitsView<Real> view()
    {
        HitsView<Real> hits;
        hits.t = t_;
        hits.object = object_;
        hits.normal_x = normal_[0];
        hits.normal_y = normal_[1];
        hits.normal_z = normal_[2];
        return hits;
    }

    void write(const HitStructs<Real>& hits, std::size_t first, std::size_t count) const
    {
        for (std::size_t i = 0; i < count; ++i) {
            SurfaceHit<Real>& hit = hits[first + i];
            hit.t = t_[i];
            hit.object = object_[i];
            for (int axis = 0; axis < 3; ++axis)
                hit.normal[axis] = object_[i] < 0 ? Real(0) : normal_[axis][i];
        }
    }

private:
    alignas(64) Real t_[chunk_rays];
    alignas(64) Real normal_[3][chunk_rays];
    alignas(64) std::int32_t object_[chunk_rays];
};

/// Copies the rays into arrays, chunk by chunk, and calls `work(arrays, first)` for each chunk.
template <class Real, class Work>
void for_chunks(const RayStructs<Real>& rays, const QueryWatch& watch, const Work& work)
{
    check_array(rays.first, "rays", rays.count);
    RayChunk<Real> chunk;
    for_watched_pieces(rays.count, watch, [&](std::size_t begin, std::size_t length) {
        for (std::size_t first = begin; first < begin + length; first += chunk_rays)
            work(chunk.fill(rays, first, std::min(chunk_rays, begin + length - first)), first);
    });
}

}  // namespace packtrace
