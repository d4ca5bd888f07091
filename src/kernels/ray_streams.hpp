#pragma once

#include "kernel_abi/ray_streams.hpp"
#include "kernels/closest.hpp"
#include "kernels/occluded.hpp"
#include "kernels/surface.hpp"

// Streams of rays from outside: closest hits, occlusion, all hits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Up to a packet of values; lanes beyond `count` repeat the first.
template <class Real>
inline vreal<Real> load_some(const Real* from, int count)
{
    if (count >= lanes<Real>)
        return load(from);
    alignas(64) Real values[lanes<Real>];
    for (int lane = 0; lane < lanes<Real>; ++lane)
        values[lane] = from[lane < count ? lane : 0];
    return load(values);
}

template <class Element, class Real>
inline void store_some(Element* to, batch<Real> x, int count)
{
    alignas(64) Real values[lanes<Real>];
    store(values, x);
    const int live = count < lanes<Real> ? count : lanes<Real>;
    for (int lane = 0; lane < live; ++lane)
        to[lane] = static_cast<Element>(values[lane]);
}

template <class Element>
inline void store_some(Element* to, vint<double> x, int count)
{
    alignas(64) std::int64_t values[lanes<double>];
    store(values, x);
    const int live = count < lanes<double> ? count : lanes<double>;
    for (int lane = 0; lane < live; ++lane)
        to[lane] = static_cast<Element>(values[lane]);
}

template <class Real>
inline Vec3v<Real> load_some3(const Real* const (&from)[3], int first, int count)
{
    return {load_some(from[0] + first, count), load_some(from[1] + first, count),
            load_some(from[2] + first, count)};
}

template <class Real>
struct StreamPacket {
    RayPacket<Real> rays;
    vreal<Real> t_max;
    int count;  ///< rays from here on, perhaps more than a packet

    StreamPacket(const abi::RaysView<Real>& view, int first) : count(view.count - first)
    {
        rays.org = load_some3(view.org, first, count);
        rays.dir = load_some3(view.dir, first, count);
        rays.dir2 = dot(rays.dir, rays.dir);
        rays.t_min = load_some(view.t_min + first, count);
        t_max = load_some(view.t_max + first, count);
    }
};

/// Outward unit normals and object numbers of the lanes of `active`.
template <abi::Features F, class Real>
inline SurfacePacket<Real> outward_surface(const abi::SceneView<Real>& scene,
                                           const RayPacket<Real>& rays, const vreal<Real>& t,
                                           const vint<Real>& surface, std::uint32_t active)
{
    SurfacePacket<Real> result =
        surface_at<F>(scene, madd<Real>(t, rays.dir, rays.org), rays.dir, surface, active);
    // Undo the turn towards the viewer: outward normals of leaving rays go along with them.
    const vreal<Real> zero(Real(0));
    const std::uint32_t against = bits(dot(result.normal, rays.dir) < zero);
    const auto turned = from_bits<Real>(result.leaving & against);
    result.normal =
        select(turned, scale<Real>(vreal<Real>(Real(-1)), result.normal), result.normal);
    return result;
}

template <abi::Features F, class Real>
inline void closest_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                         const abi::HitsView<Real>& hits)
{
    for (int first = 0; first < view.count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        HitPacket<Real> hit{packet.t_max, vint<Real>(lane_int<Real>(-1))};
        closest_hit<F>(hit, scene, packet.rays);
        const auto missed = int_equal(hit.surface, vint<Real>(lane_int<Real>(-1)));
        const std::uint32_t found = ~bits(missed) & first_lanes<Real>(packet.count);
        const SurfacePacket<Real> surface =
            outward_surface<F>(scene, packet.rays, hit.t, hit.surface, found);
        store_some(hits.t + first, hit.t, packet.count);
        store_some(hits.object + first, select(missed, hit.surface, surface.object), packet.count);
        if (hits.normal[0] == nullptr)
            continue;
        store_some(hits.normal[0] + first, surface.normal.x, packet.count);
        store_some(hits.normal[1] + first, surface.normal.y, packet.count);
        store_some(hits.normal[2] + first, surface.normal.z, packet.count);
    }
}

template <abi::Features F, class Real>
inline void occluded_rays(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                          std::uint8_t* mask)
{
    for (int first = 0; first < view.count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        const std::uint32_t wanted = first_lanes<Real>(packet.count);
        const std::uint32_t blocked =
            occluded<F>(StreamRange<Real>{packet.t_max}, scene, packet.rays, wanted);
        const int live = packet.count < lanes<Real> ? packet.count : lanes<Real>;
        for (int lane = 0; lane < live; ++lane)
            mask[first + lane] = static_cast<std::uint8_t>((blocked >> lane) & 1u);
    }
}

/// Hands the crossings of one surface to the sink.
template <abi::Features F, class Real>
inline void report_hits(const abi::SceneView<Real>& scene, const StreamPacket<Real>& packet,
                        int first, const abi::HitSink<Real>& sink, vmask<Real> valid,
                        const vreal<Real>& t, std::int32_t surface)
{
    std::uint32_t active = bits(valid & (t > packet.rays.t_min) & (t < packet.t_max)) &
                           first_lanes<Real>(packet.count);
    if (active == 0)
        return;
    const SurfacePacket<Real> at = outward_surface<F>(
        scene, packet.rays, t, vint<Real>(static_cast<lane_int<Real>>(surface)), active);
    alignas(64) Real ts[lanes<Real>];
    alignas(64) Real normals[3][lanes<Real>];
    store(ts, t);
    store(normals[0], at.normal.x);
    store(normals[1], at.normal.y);
    store(normals[2], at.normal.z);
    const std::int32_t object = scene.material_index[surface].object;
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        const Real normal[3] = {normals[0][lane], normals[1][lane], normals[2][lane]};
        sink.take(sink.context, first + lane, ts[lane], object, normal);
    }
}

template <abi::Features F, class Real>
inline void all_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                     const abi::HitSink<Real>& sink)
{
    for (int first = 0; first < view.count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        const auto report = [&](vmask<Real> valid, const vreal<Real>& t, std::int32_t surface) {
            report_hits<F>(scene, packet, first, sink, valid, t, surface);
        };
        visit_all_crossings<F>(scene, packet.rays, report);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
