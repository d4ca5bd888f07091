#pragma once

#include "kernel_abi/probe.hpp"
#include "kernels/geometry/packet.hpp"
#include "kernels/stream/tile_memory.hpp"

// Records single rays, in kernels with Features::probe; empty in the others.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The weight and pixel of a hit's path.
template <class Real>
struct PathPacket {
    Vec3v<Real> weight;
    vint<Real> pixel;
    vint<Real> id;  ///< abi::PathId; only with a probe
};

template <class Real>
struct LaneIntegers {
    alignas(64) lane_int<Real> value[lanes<Real>];

    explicit LaneIntegers(const vint<Real>& v)
    {
        store(value, v);
    }
};

/// The rays of the probed pixel in a packet; if `On` is false, no rays.
template <bool On, class Real>
struct PacketProbe {
    void light(int, std::uint32_t, std::uint32_t, const Vec3v<Real>&) const
    {
    }
    void light(int, std::uint32_t, const Vec3v<Real>&, const Vec3v<Real>&) const
    {
    }
    void hit(const SurfacePacket<Real>&, const Vec3v<Real>&) const
    {
    }
    void last_hit(const SurfacePacket<Real>&, const Vec3v<Real>&, const Vec3v<Real>&,
                  const Vec3v<Real>&) const
    {
    }
};

template <class Real>
struct PacketProbe<true, Real> {
    const abi::Probe<Real>* probe;  ///< null: no pixel is probed
    const PathPacket<Real>& path;
    std::uint32_t probed = 0;  ///< lanes of the probed pixel

    PacketProbe(const abi::Probe<Real>* probe_, const PathPacket<Real>& path_, std::uint32_t active)
        : probe(probe_), path(path_)
    {
        if (probe != nullptr)
            probed =
                active &
                bits(int_equal(path.pixel, vint<Real>(static_cast<lane_int<Real>>(probe->pixel))));
    }

    /// Calls `visit(lane, path)` for each of these rays.
    template <class Visit>
    void each(const Visit& visit) const
    {
        const LaneIntegers<Real> id(path.id);
        for (std::uint32_t rest = probed; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest);
            visit(lane, static_cast<abi::PathId>(id.value[lane]));
        }
    }

    void ray(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
             const HitPacket<Real>& hit, const Vec3v<Real>& seen) const
    {
        if (probed == 0)
            return;
        const LaneVectors<Real> org(rays.org), dir(rays.dir), weight(path.weight), missed(seen);
        const LaneVectors<Real> t({hit.t, hit.t, hit.t});
        const LaneIntegers<Real> surface(hit.surface);
        each([&](int lane, abi::PathId id) {
            abi::ProbedRay<Real> event{};
            event.path = id;
            org.copy(lane, event.org);
            dir.copy(lane, event.dir);
            weight.copy(lane, event.weight);
            event.t = t.axis[0][lane];
            const auto number = surface.value[lane];
            event.object = number < 0 ? -1 : scene.materials.of_surface[number].object;
            if (number < 0)
                missed.copy(lane, event.seen);
            probe->ray(probe->context, event);
        });
    }

    /// Records a light whose share is 1 in the lanes of `lit`, else 0.
    void light(int number, std::uint32_t can_add, std::uint32_t lit, const Vec3v<Real>& color) const
    {
        const vreal<Real> share =
            select(from_bits<Real>(lit), vreal<Real>(Real(1)), vreal<Real>(Real(0)));
        light(number, can_add, {share, share, share}, color);
    }

    void light(int number, std::uint32_t can_add, const Vec3v<Real>& share,
               const Vec3v<Real>& color) const
    {
        if (probed == 0)
            return;
        const LaneVectors<Real> shares(share), colors(color);
        each([&](int lane, abi::PathId id) {
            abi::ProbedLight<Real> event{};
            event.path = id;
            event.light = number;
            event.can_add = static_cast<std::int32_t>((can_add >> lane) & 1u);
            if (event.can_add != 0)
                shares.copy(lane, event.share);
            colors.copy(lane, event.color);
            probe->light(probe->context, event);
        });
    }

    void hit(const SurfacePacket<Real>& surface, const Vec3v<Real>& local) const
    {
        const vreal<Real> zero(Real(0));
        last_hit(surface, local, {zero, zero, zero}, {zero, zero, zero});
    }

    /// Records a hit at the depth limit, which adds `limit` times `share` instead of child rays.
    void last_hit(const SurfacePacket<Real>& surface, const Vec3v<Real>& local,
                  const Vec3v<Real>& share, const Vec3v<Real>& limit) const
    {
        if (probed == 0)
            return;
        const LaneVectors<Real> points(surface.point), normals(surface.normal), locals(local),
            limits(share * limit);
        each([&](int lane, abi::PathId id) {
            abi::ProbedHit<Real> event{};
            event.path = id;
            points.copy(lane, event.point);
            normals.copy(lane, event.normal);
            locals.copy(lane, event.local);
            limits.copy(lane, event.at_limit);
            probe->hit(probe->context, event);
        });
    }
};

/// Whether a pixel is probed.
template <abi::Features F, class Real>
inline bool is_probed(const abi::TileJob<Real>& job)
{
    return F.probe && job.probe != nullptr;
}

template <abi::Features F, class Real>
inline PacketProbe<F.probe, Real> packet_probe(const HitStream<F, Real>& hits,
                                               const PathPacket<Real>& path, std::uint32_t active)
{
    if constexpr (F.probe)
        return {hits.probe, path, active};
    else
        return {};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
