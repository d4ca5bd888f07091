#pragma once

#include "kernels/camera.hpp"
#include "kernels/closest.hpp"
#include "kernels/shade.hpp"

// From rays to hit points, one generation at a time.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct HitRays {
    RayPacket<Real> rays;
    Vec3v<Real> weight;
    vint<Real> pixel;
};

template <class Real>
inline void append_hits(HitStream<Real>& hits, const HitRays<Real>& from,
                        const HitPacket<Real>& hit, std::uint32_t active)
{
    if (active == 0)
        return;
    append3(hits.point, hits.count, active, madd<Real>(hit.t, from.rays.dir, from.rays.org));
    append3(hits.dir, hits.count, active, from.rays.dir);
    append3(hits.weight, hits.count, active, from.weight);
    compress_store(hits.pixel + hits.count, active, from.pixel);
    compress_store(hits.object + hits.count, active, hit.object);
    hits.count += __builtin_popcount(active);
}

template <class Real>
inline std::uint32_t hit_lanes(const HitPacket<Real>& hit)
{
    return ~bits(int_equal(hit.object, vint<Real>(lane_int<Real>(-1)))) & all_lanes<Real>;
}

template <class Real>
inline vint<Real> lane_numbers(int first)
{
    alignas(64) static constexpr lane_int<Real> number[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                              8, 9, 10, 11, 12, 13, 14, 15};
    return load(number) + vint<Real>(static_cast<lane_int<Real>>(first));
}

/// The camera rays of a tile; pixels start as the background, and as 0 where something is hit.
template <class Real>
inline void trace_camera(const abi::TileJob<Real>& job, const SharedOriginObjects<Real>& visible,
                         TileMemory<Real>& memory)
{
    const TileCamera<Real> camera(job);
    const vreal<Real> one(Real(1));
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        const std::uint32_t inside = lanes_inside(job, first);
        if (inside == 0)
            continue;
        const RayPacket<Real> rays = camera_rays(camera, first);
        HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
        closest_hit(hit, visible, rays);
        append_hits<Real>(memory.hits, {rays, {one, one, one}, lane_numbers<Real>(first)}, hit,
                          hit_lanes(hit) & inside);
    }
}

/// A stream of secondary rays; the background goes into the pixels of those that miss.
template <class Real>
inline void trace_secondary(const abi::SceneView<Real>& scene, const RayStream<Real>& stream,
                            TileMemory<Real>& memory)
{
    memory.hits.count = 0;
    for (int first = 0; first < stream.count; first += lanes<Real>) {
        const std::uint32_t active = first_lanes<Real>(stream.count - first);
        const HitRays<Real> from{
            make_rays<Real>(load3(stream.org, first), load3(stream.dir, first), scene.epsilon),
            load3(stream.weight, first), load(stream.pixel + first)};
        HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
        closest_hit(hit, scene, from.rays);
        const std::uint32_t hits = hit_lanes(hit) & active;
        append_hits(memory.hits, from, hit, hits);
        write_colors<PixelWrite::add>(memory.color, from.pixel,
                                      from.weight * broadcast(scene.background), active & ~hits);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
