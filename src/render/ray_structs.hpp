#pragma once

#include <algorithm>

#include <packtrace/rays.hpp>

#include "render/watched_pieces.hpp"

// Rays in structs, copied into arrays for kernels, and their hits back, a chunk at a time.
namespace packtrace {

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

/// Calls `work(rays, first)` for chunks of the rays, in arrays.
template <class Real, class Work>
void for_chunks(const RayStructs<Real>& rays, const QueryWatch& watch, const Work& work)
{
    RayChunk<Real> chunk;
    for_watched_pieces(rays.count, watch, [&](std::size_t begin, std::size_t length) {
        for (std::size_t first = begin; first < begin + length; first += chunk_rays)
            work(chunk.fill(rays, first, std::min(chunk_rays, begin + length - first)), first);
    });
}

}  // namespace packtrace
