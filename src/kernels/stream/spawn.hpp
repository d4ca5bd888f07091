#pragma once

#include "kernels/precision/leave_surface.hpp"
#include "kernels/stream/probe.hpp"

// Appends the child rays of a packet of hits, reflected and refracted rays, to streams.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The origins of child rays, which continue outside in the lanes of `outside`, inside in the
/// others.
template <class Real>
inline Vec3v<Real> start_point(const SurfacePacket<Real>& surface, std::uint32_t outside)
{
    return select(from_bits<Real>(outside & all_lanes<Real>), surface.point + surface.offset,
                  surface.point - surface.offset);
}

/// Child rays of a packet of surfaces.
template <class Real>
struct ChildPacket {
    Vec3v<Real> dir;
    std::uint32_t outside;  ///< lanes that continue outside
    int branch;             ///< bit of their ids: 0 for reflected and 1 for refracted rays
};

/// Appends the surfaces that child rays start on.
template <abi::Features F, class Real, class Lanes>
inline void append_start(RayStream<F, Real>& next, const SurfacePacket<Real>& surface,
                         const SecondHit<Real>& second, const Lanes& chosen)
{
    append3(next.starts->point, next.count, chosen, surface.point);
    chosen.append(next.starts->surface + next.count, surface.number);
    chosen.append(next.starts->second + next.count, second.t);
    chosen.append(next.starts->met_again + next.count, second.surface);
}

template <abi::Features F, class Real>
inline void append_children(RayStream<F, Real>& next, const abi::SceneView<Real>& scene,
                            const SurfacePacket<Real>& surface, const PathPacket<Real>& path,
                            const Vec3v<Real>& share, const GlassPacket<Real>& inside,
                            const ChildPacket<Real>& child, std::uint32_t active)
{
    count_packet<Real>(abi::PacketWork::children, active);
    const Vec3v<Real> org = start_point(surface, child.outside);
    const Vec3v<Real> weight = path.weight * share;
    SecondHit<Real> second = no_second_hit<Real>();
    if (next.starts != nullptr)
        second = second_hit<Real>(scene.shapes, surface.number, surface.point, child.dir,
                                  vreal<Real>(scene.rules.secondary_t_min), child.outside, active);
    with_appender<Real>(active, [&](const auto& chosen) {
        append3(next.org, next.count, chosen, org);
        append3(next.dir, next.count, chosen, child.dir);
        append_weight(next, chosen, weight);
        chosen.append(next.pixel + next.count, path.pixel);
        if (next.starts != nullptr)
            append_start(next, surface, second, chosen);
        append_glass(next, chosen, inside);
        if constexpr (F.probe)
            chosen.append(next.path + next.count,
                          path.id + path.id + vint<Real>(lane_int<Real>{child.branch}));
    });
    next.count += __builtin_popcount(active);
}

template <class Real>
inline Vec3v<Real> reflected(const SurfacePacket<Real>& surface)
{
    const vreal<Real> twice = dot(surface.normal, surface.dir) * vreal<Real>(Real(-2));
    return madd<Real>(twice, surface.normal, surface.dir);
}

template <abi::Features F, class Real>
inline void spawn_reflected(RayStream<F, Real>& next, const abi::SceneView<Real>& scene,
                            const SurfacePacket<Real>& surface, const PathPacket<Real>& path,
                            const Vec3v<Real>& reflect, const GlassPacket<Real>& inside,
                            std::uint32_t active)
{
    if (active != 0)
        append_children(next, scene, surface, path, reflect, inside,
                        {reflected(surface), ~surface.leaving, 0}, active);
}

template <abi::Features F, class Real>
inline void spawn_refracted(RayStream<F, Real>& next, const abi::SceneView<Real>& scene,
                            const SurfacePacket<Real>& surface, const PathPacket<Real>& path,
                            const Vec3v<Real>& transmit, const RefractedPacket<Real>& refracted,
                            std::uint32_t active)
{
    if (active != 0)
        append_children(next, scene, surface, path, transmit, refracted.inside,
                        {refracted.dir, surface.leaving, 1}, active);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
