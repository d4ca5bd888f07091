#pragma once

#include "kernels/precision/leave_surface.hpp"
#include "kernels/stream/probe.hpp"

// Children of a packet of hits: mirrored and refracted rays, appended to streams.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F, class Real>
inline void append_ray(RayStream<F, Real>& next, const Vec3v<Real>& org, const Vec3v<Real>& dir,
                       const Vec3v<Real>& weight, const vint<Real>& pixel, std::uint32_t active)
{
    append3(next.org, next.count, active, org);
    append3(next.dir, next.count, active, dir);
    append_weight(next, active, weight);
    compress_store(next.pixel + next.count, active, pixel);
}

/// `append_ray` does not count, so that the glass of the same rays goes to the same place.
template <abi::Features F, class Real>
inline void append_glass(RayStream<F, Real>& next, const GlassPacket<Real>& inside,
                         std::uint32_t active)
{
    if constexpr (F.glass)
        for (int i = 0; i < abi::glass_depth; ++i)
            compress_store(next.inside[i] + next.count, active, inside.body[i]);
}

/// The children's ids: `branch` is 0 for mirrored and 1 for refracted rays.
template <abi::Features F, class Real>
inline void append_path(RayStream<F, Real>& next, const vint<Real>& parent, int branch,
                        std::uint32_t active)
{
    if constexpr (F.probe)
        compress_store(next.path + next.count, active,
                       parent + parent + vint<Real>(static_cast<lane_int<Real>>(branch)));
}

/// Where rays start that go on outside in the lanes of `outside`, inside in the others.
template <class Real>
inline Vec3v<Real> start_point(const SurfacePacket<Real>& surface, std::uint32_t outside)
{
    return select(from_bits<Real>(outside & all_lanes<Real>), surface.point + surface.lift,
                  surface.point - surface.lift);
}

/// What rays that leave a surface in the direction `dir` are told of it.
template <abi::Features F, class Real>
inline void append_start(RayStream<F, Real>& next, const abi::SceneView<Real>& scene,
                         const SurfacePacket<Real>& surface, const Vec3v<Real>& dir,
                         std::uint32_t outside, std::uint32_t active)
{
    if (next.starts == nullptr)
        return;
    append3(next.starts->point, next.count, active, surface.point);
    compress_store(next.starts->surface + next.count, active, surface.number);
    const SecondHit<Real> second =
        second_hit<Real>(scene.shapes, surface.number, surface.point, dir,
                         vreal<Real>(scene.rules.secondary_t_min), outside, active);
    compress_store(next.starts->second + next.count, active, second.t);
    compress_store(next.starts->met_again + next.count, active, second.surface);
}

template <class Real>
inline Vec3v<Real> mirrored(const SurfacePacket<Real>& surface)
{
    const vreal<Real> twice = dot(surface.normal, surface.dir) * vreal<Real>(Real(-2));
    return madd<Real>(twice, surface.normal, surface.dir);
}

template <abi::Features F, class Real>
inline void spawn_mirrored(RayStream<F, Real>& next, const abi::SceneView<Real>& scene,
                           const SurfacePacket<Real>& surface, const PathPacket<Real>& path,
                           const Vec3v<Real>& reflect, const GlassPacket<Real>& inside,
                           std::uint32_t active)
{
    if (active == 0)
        return;
    count_packet<Real>(abi::PacketWork::children, active);
    const Vec3v<Real> dir = mirrored(surface);
    append_ray(next, start_point(surface, ~surface.leaving), dir, path.weight * reflect, path.pixel,
               active);
    append_start(next, scene, surface, dir, ~surface.leaving, active);
    append_glass(next, inside, active);
    append_path(next, path.id, 0, active);
    next.count += __builtin_popcount(active);
}

template <abi::Features F, class Real>
inline void spawn_refracted(RayStream<F, Real>& next, const abi::SceneView<Real>& scene,
                            const SurfacePacket<Real>& surface, const PathPacket<Real>& path,
                            const Vec3v<Real>& transmit, const RefractedPacket<Real>& refracted,
                            std::uint32_t active)
{
    if (active == 0)
        return;
    count_packet<Real>(abi::PacketWork::children, active);
    append_ray(next, start_point(surface, surface.leaving), refracted.dir, path.weight * transmit,
               path.pixel, active);
    append_start(next, scene, surface, refracted.dir, surface.leaving, active);
    append_glass(next, refracted.inside, active);
    append_path(next, path.id, 1, active);
    next.count += __builtin_popcount(active);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
