#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/shade/glass.hpp"
#include "kernels/stream/pixels.hpp"

// The working memory of tiles: streams of rays as structures of arrays.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The largest number of rays that are traced, or hits that are shaded, at once, whatever the
/// packet width.
inline constexpr int chunk_rays = abi::tile_pixels;

/// The largest number of child rays of a chunk: one per ray, or two if glass refracts.
template <abi::Features F>
inline constexpr int stream_rays = F.glass ? 2 * chunk_rays : chunk_rays;

/// The array has padding for one packet after the last ray.
template <abi::Features F, class Element>
using StreamArray = Element[stream_rays<F> + abi::padding];

/// The glass that each ray is in; only with Features::glass.
template <bool Glass, abi::Features F, class Real>
struct GlassArrays {
};
template <abi::Features F, class Real>
struct GlassArrays<true, F, Real> {
    StreamArray<F, lane_int<Real>> inside[abi::glass_depth];
};

/// The path of each ray, and the receiver of events; only with a probe.
template <bool Probe, abi::Features F, class Real>
struct PathArrays {
};
template <abi::Features F, class Real>
struct PathArrays<true, F, Real> {
    StreamArray<F, lane_int<Real>> path;
    const abi::Probe<Real>* probe;  ///< set in hits; null if no pixel is probed
    int reflected_count;  ///< set in rays: the number of reflected rays, which come before the
                          ///< refracted ones
};

/// The start of rays that leave a surface, for SelfHits::exact.
template <abi::Features F, class Real>
struct StartArrays {
    StreamArray<F, Real> point[3];
    StreamArray<F, lane_int<Real>> surface;
    StreamArray<F, Real> second;  ///< t at which they hit their own object again, from `point`
    StreamArray<F, lane_int<Real>> met_again;  ///< the surface that they hit there
};

/// Rays of one generation, in an order that does not depend on the packet width.
template <abi::Features F, class Real>
struct alignas(64) RayStream : GlassArrays<F.glass, F, Real>, PathArrays<F.probe, F, Real> {
    StreamArray<F, Real> weight[abi::weight_channels(F)];  ///< weight of each ray's path so far
    StreamArray<F, Real> org[3];
    StreamArray<F, Real> dir[3];
    StreamArray<F, lane_int<Real>> pixel;  ///< number in the tile, along its Z-order curve
    StartArrays<F, Real>* starts;          ///< null with SelfHits::note
    int count = 0;
};

/// The hits of a chunk of rays.
template <abi::Features F, class Real>
struct alignas(64) HitStream : GlassArrays<F.glass, F, Real>, PathArrays<F.probe, F, Real> {
    StreamArray<F, Real> weight[abi::weight_channels(F)];
    StreamArray<F, Real> point[3];
    StreamArray<F, Real> normal[3];  ///< outwards and unit
    StreamArray<F, Real> dir[3];
    StreamArray<F, lane_int<Real>> pixel;
    StreamArray<F, lane_int<Real>> surface;
    int count = 0;
};

template <abi::Features F, class Real>
struct alignas(64) TileMemory {
    Real* color;  ///< of all pixels of the tiles that are rendered together
    HitStream<F, Real> hits;
};

template <class Real, std::size_t Length>
inline Vec3v<Real> load3(const Real (&from)[3][Length], int first)
{
    return {load(from[0] + first), load(from[1] + first), load(from[2] + first)};
}

/// Appends the chosen lanes of packets to arrays, in order.
struct ChosenLanes {
    std::uint32_t pattern;

    template <class Element, class Packet>
    void append(Element* to, const Packet& x) const
    {
        compress_store(to, pattern, x);
    }
};

/// Appends whole packets to arrays.
struct WholePacket {
    template <class Element, class Packet>
    static void append(Element* to, const Packet& x)
    {
        store(to, x);
    }
};

/// Calls `visit` with an object that appends the lanes of `active`. Most packets are whole and need
/// no compression.
template <class Real, class Visit>
inline void with_appender(std::uint32_t active, const Visit& visit)
{
    if (active == all_lanes<Real>)
        visit(WholePacket{});
    else
        visit(ChosenLanes{active});
}

template <class Real, std::size_t Length, class Lanes>
inline void append3(Real (&to)[3][Length], int at, const Lanes& chosen, const Vec3v<Real>& v)
{
    chosen.append(to[0] + at, v.x);
    chosen.append(to[1] + at, v.y);
    chosen.append(to[2] + at, v.z);
}

/// The weights of a packet of a stream.
template <template <abi::Features, class> class Stream, abi::Features F, class Real>
inline Vec3v<Real> load_weight(const Stream<F, Real>& stream, int first)
{
    if constexpr (abi::weight_channels(F) == 3) {
        return load3(stream.weight, first);
    } else {
        const vreal<Real> weight = load(stream.weight[0] + first);
        return {weight, weight, weight};
    }
}

/// Appends weights; does not change the count.
template <template <abi::Features, class> class Stream, abi::Features F, class Real, class Lanes>
inline void append_weight(Stream<F, Real>& stream, const Lanes& chosen, const Vec3v<Real>& weight)
{
    if constexpr (abi::weight_channels(F) == 3)
        append3(stream.weight, stream.count, chosen, weight);
    else
        chosen.append(stream.weight[0] + stream.count, weight.x);
}

/// Appends glass bodies; does not change the count.
template <template <abi::Features, class> class Stream, abi::Features F, class Real, class Lanes>
inline void append_glass(Stream<F, Real>& stream, const Lanes& chosen,
                         const GlassPacket<Real>& inside)
{
    if constexpr (F.glass)
        for (int i = 0; i < abi::glass_depth; ++i)
            chosen.append(stream.inside[i] + stream.count, inside.body[i]);
}

/// The glass of a packet of a stream; not set if the stream has none.
template <template <abi::Features, class> class Stream, abi::Features F, class Real>
inline GlassPacket<Real> load_glass(const Stream<F, Real>& stream, int first)
{
    GlassPacket<Real> glass;
    if constexpr (F.glass)
        for (int i = 0; i < abi::glass_depth; ++i)
            glass.body[i] = load(stream.inside[i] + first);
    return glass;
}

/// The paths of a packet of a stream; 0 without a probe.
template <template <abi::Features, class> class Stream, abi::Features F, class Real>
inline vint<Real> load_path(const Stream<F, Real>& stream, int first)
{
    if constexpr (F.probe)
        return load(stream.path + first);
    else
        return vint<Real>(lane_int<Real>(0));
}

/// The start of a packet of a stream.
template <abi::Features F, class Real>
inline StartPacket<Real> load_start(const RayStream<F, Real>& stream, int first)
{
    if (stream.starts == nullptr)
        return no_start<Real>();
    return {load3(stream.starts->point, first),
            load(stream.starts->surface + first),
            {load(stream.starts->second + first), load(stream.starts->met_again + first)}};
}

/// The surfaces of a packet of a stream of hits.
template <abi::Features F, class Real>
inline SurfacePacket<Real> surface_of(const abi::SceneView<Real>& scene,
                                      const HitStream<F, Real>& hits, int first,
                                      std::uint32_t active)
{
    const Vec3v<Real> point = load3(hits.point, first);
    const Vec3v<Real> dir = load3(hits.dir, first);
    return surface_at<Real>(scene, point, load3(hits.normal, first), dir,
                            load(hits.surface + first), active);
}

/// Copies whole packets, so that up to a packet less one element is written beyond the end.
template <class Real, class Element>
inline void copy_packets(Element* to, const Element* from, int count)
{
    for (int i = 0; i < count; i += lanes<Real>)
        store(to + i, load(from + i));
}

/// Calls `visit(array)` for each array of streams of rays; `array(stream)` is that array of a
/// stream.
template <abi::Features F, class Visit>
inline void for_each_array(bool have_starts, const Visit& visit)
{
    for (int axis = 0; axis < 3; ++axis) {
        visit([axis](auto& rays) { return rays.org[axis]; });
        visit([axis](auto& rays) { return rays.dir[axis]; });
        if (have_starts)
            visit([axis](auto& rays) { return rays.starts->point[axis]; });
    }
    for (std::size_t channel = 0; channel < abi::weight_channels(F); ++channel)
        visit([channel](auto& rays) { return rays.weight[channel]; });
    visit([](auto& rays) { return rays.pixel; });
    if constexpr (F.glass)
        for (int i = 0; i < abi::glass_depth; ++i)
            visit([i](auto& rays) { return rays.inside[i]; });
    if constexpr (F.probe)
        visit([](auto& rays) { return rays.path; });
    if (have_starts) {
        visit([](auto& rays) { return rays.starts->surface; });
        visit([](auto& rays) { return rays.starts->second; });
        visit([](auto& rays) { return rays.starts->met_again; });
    }
}

/// Appends the rays of `from` to `to`.
template <abi::Features F, class Real>
inline void append_stream(RayStream<F, Real>& to, const RayStream<F, Real>& from)
{
    for_each_array<F>(to.starts != nullptr, [&](const auto& array) {
        copy_packets<Real>(array(to) + to.count, array(from), from.count);
    });
    to.count += from.count;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
