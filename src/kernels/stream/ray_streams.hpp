#pragma once

#include "kernel_abi/ray_streams.hpp"
#include "kernels/precision/refine.hpp"
#include "kernels/stream/stream_values.hpp"
#include "kernels/stream/workspace.hpp"
#include "kernels/traverse/bvh_closest.hpp"
#include "kernels/traverse/bvh_crossings.hpp"
#include "kernels/traverse/bvh_occluded.hpp"
#include "kernels/traverse/common_hit.hpp"
#include "kernels/traverse/object_sets.hpp"
#include "kernels/traverse/retrace_closest.hpp"
#include "kernels/traverse/retrace_occluded.hpp"

// Streams of rays from outside: closest hits, occlusion, all hits.
namespace packtrace::PACKTRACE_ISA {
namespace {

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

/// Object numbers of the lanes of `active`; the others keep what they have or, where every surface
/// is an object of its own, all.
template <class Real>
inline vint<Real> objects_of(const abi::SceneView<Real>& scene, const vint<Real>& surface,
                             std::uint32_t active)
{
    if (scene.materials.surfaces_are_objects)
        return surface;
    alignas(64) lane_int<Real> number[lanes<Real>];
    store(number, surface);
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        number[lane] = scene.materials.of_surface[number[lane]].object;
    }
    return load(number);
}

/// Lanes in which nothing is NaN.
template <class Real>
inline std::uint32_t numbers(const StreamPacket<Real>& packet)
{
    const RayPacket<Real>& rays = packet.rays;
    const auto is_number = [](const vreal<Real>& x) { return bits(x == x); };
    return is_number(rays.org.x) & is_number(rays.org.y) & is_number(rays.org.z) &
           is_number(rays.dir.x) & is_number(rays.dir.y) & is_number(rays.dir.z) &
           is_number(rays.t_min) & is_number(packet.t_max);
}

/// Where a packet of a stream starts, if its caller says so.
template <class Real>
inline StartPacket<Real> start_of(const abi::SceneView<Real>& scene,
                                  const abi::RaysView<Real>& view, int first,
                                  const RayPacket<Real>& rays)
{
    if (view.start_surface == nullptr || !(scene.rules.start_error > 0))
        return no_start<Real>();
    const int count = view.count - first;
    const vint<Real> none(lane_int<Real>(-1));
    const vint<Real> code = load_numbers<Real>(view.start_surface + first, count);
    const auto inner = int_less(code, vint<Real>(lane_int<Real>(0)));
    const auto elsewhere = int_equal(code, vint<Real>(lane_int<Real>{abi::no_start}));
    const vint<Real> number = select(elsewhere, none, select(inner, none - code, code));
    const std::uint32_t active = first_lanes<Real>(count) & ~bits(elsewhere);
    const Vec3v<Real> point = load_some3(view.start_point, first, count);
    return {
        point, number,
        second_hit<Real>(scene.shapes, number, point, rays.dir, rays.t_min, ~bits(inner), active)};
}

/// After packets without a common hit more and more are not asked for one, so that rays without a
/// common way cost next to nothing.
struct CommonPause {
    static constexpr int longest = 256;
    int length = 1;
    int left = 0;

    /// Whether the next packet is to be asked.
    bool is_over()
    {
        if (left == 0)
            return true;
        --left;
        return false;
    }
    void record(bool found)
    {
        left = found ? 0 : length - 1;
        length = found ? 1 : length < longest ? 2 * length : longest;
    }
};

/// Whether a packet's rays run nearly the same way: within 25 degrees of the first.
template <class Real>
inline bool run_together(const abi::RaysView<Real>& view, int begin)
{
    const Vec3v<Real> dir = load_some3(view.dir, begin, view.count - begin);
    const Real first[3] = {view.dir[0][begin], view.dir[1][begin], view.dir[2][begin]};
    const Vec3v<Real> axis = broadcast(first);
    const vreal<Real> along = dot(dir, axis);
    return all(along * abs(along) > vreal<Real>(Real(0.82)) * dot(dir, dir) * dot(axis, axis));
}

/// What is prepared of the lists for one call.
template <abi::Features F, class Real>
struct StreamWork {
    FromAnywhere<F, Real> nearby;
    FromPoint<F, Real> from_point;  ///< in place of `nearby` for rays from one point
    bool shares_origin = false;     ///< the chunk's rays are such rays
    CommonObjects common;           ///< in exact mode, without a hierarchy
    bool wants_common = false;      ///< closest hits are asked for, without a hierarchy
    CommonPause pause;              ///< of the packets before
    RayBundle<Real>* bundle = nullptr;
    std::size_t bytes = 0;

    /// With no `scratch`, only `bytes` is of use.
    StreamWork(void* scratch, const abi::SceneView<Real>& scene)
    {
        Arena arena(scratch);
        take_objects<F>(arena, nearby, scene);
        if constexpr (F.exact)
            if (scene.tree.empty())
                common.take(arena, scene);
        if (scene.tree.empty())
            take_objects<F>(arena, from_point, scene);
        else
            bundle = arena.template take<RayBundle<Real>>(1);
        bytes = arena.used();
    }

    /// Whether packets of a chunk are asked for common hits: rays that run apart have none, and few
    /// are not worth what is prepared.
    bool looks_for_common(const abi::RaysView<Real>& view, int begin, int count)
    {
        common.are_all = false;
        return wants_common && count >= fewest_in_common && view.start_surface == nullptr &&
               run_together(view, begin);
    }
    static constexpr int fewest_in_common = 256;
};

/// Fewer rays are not worth what is computed once for a shared origin.
inline constexpr int fewest_sharing = 64;

/// Whether a chunk's rays all start at the same point, as those from an eye or a light do. Zeros of
/// both signs are not the same, so that results have the same bits either way.
template <class Real>
inline bool start_together(const abi::RaysView<Real>& view, int begin, int count)
{
    if (count < fewest_sharing)
        return false;
    const Real* const x = view.org[0] + begin;
    const Real* const y = view.org[1] + begin;
    const Real* const z = view.org[2] + begin;
    const Vec3v<Real> one{vreal<Real>(*x), vreal<Real>(*y), vreal<Real>(*z)};
    const auto differs = [](const vreal<Real>& a, const vreal<Real>& b) {
        return as_int(a) ^ as_int(b);
    };
    // The last packet may overlap the one before.
    for (int first = 0; first < count;) {
        const int at = first + lanes<Real> <= count ? first : count - lanes<Real>;
        const vint<Real> any_differs = differs(load(x + at), one.x) | differs(load(y + at), one.y) |
                                       differs(load(z + at), one.z);
        if (bits(int_equal(any_differs, vint<Real>(lane_int<Real>(0)))) != all_lanes<Real>)
            return false;
        first = at + lanes<Real>;
    }
    return true;
}

/// Prepares the lists for a chunk of a stream.
template <abi::Features F, class Real>
inline void find_nearby_of(StreamWork<F, Real>& work, const abi::SceneView<Real>& scene,
                           const abi::RaysView<Real>& view, int begin, int count)
{
    work.shares_origin =
        scene.tree.empty() && view.start_surface == nullptr && start_together(view, begin, count);
    const Real first[3] = {view.org[0][begin], view.org[1][begin], view.org[2][begin]};
    if (work.shares_origin) {
        find_from_point<F, Real>(work.from_point, first, scene);
        if constexpr (F.exact)
            if (work.looks_for_common(view, begin, count))
                fill_common(work.common, scene, near_origins(scene, first, first), first);
        return;
    }
    if constexpr (F.exact) {
        const vreal<float> never(__builtin_inff());
        const vreal<float> before = negated(never);
        Vec3v<float> lows{never, never, never};
        Vec3v<float> highs{before, before, before};
        for (int ray = 0; ray < count; ray += lanes<float>) {
            const Vec3v<float> org = load_some3(view.org, begin + ray, count - ray);
            lows = {min(lows.x, org.x), min(lows.y, org.y), min(lows.z, org.z)};
            highs = {max(highs.x, org.x), max(highs.y, org.y), max(highs.z, org.z)};
        }
        float low[3];
        float high[3];
        extent_of_lanes(lows.x, highs.x, low[0], high[0]);
        extent_of_lanes(lows.y, highs.y, low[1], high[1]);
        extent_of_lanes(lows.z, highs.z, low[2], high[2]);
        const Origins origins = origins_in(low, high);
        find_objects<F>(work.nearby, origins, scene);
        if (work.looks_for_common(view, begin, count))
            fill_common(work.common, scene, near_origins(scene, low, high), first);
    } else {
        work.nearby.scene = &scene;
    }
}

/// Hands out what a packet of rays, of which `live` are left, hit: to `at` and after.
template <abi::Features F, class Real>
inline void store_packet_hits(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                              const HitPacket<Real>& hit, const StartPacket<Real>& start,
                              const vreal<Real>& t_max, const abi::HitsView<Real>& hits, int at,
                              int live)
{
    const auto missed = int_equal(hit.surface, no_surface<Real>());
    const std::uint32_t found = ~bits(missed) & first_lanes<Real>(live);
    store_numbers<Real>(hits.object + at, objects_of(scene, hit.surface, found), live);
    if (hits.surface != nullptr)
        store_numbers<Real>(hits.surface + at, hit.surface, live);
    if (hits.normal[0] == nullptr) {
        if (hits.t == nullptr)
            return;
        vreal<Real> t = hit.t;
        if (F.exact && found != 0)
            t = refined<F, Refine::t>(scene.shapes, rays, hit, start, found).t;
        store_some(hits.t + at, select(missed, t_max, t), live);
        return;
    }
    const vreal<Real> zero(Real(0));
    const Vec3v<Real> nothing{zero, zero, zero};
    RefinedHits<Real> places{t_max, nothing, nothing};
    Vec3v<Real> offset = nothing;
    if (found != 0) {
        places = refined<F, Refine::place>(scene.shapes, rays, hit, start, found);
        places.t = select(missed, t_max, places.t);
        places.normal = select(missed, nothing, places.normal);
        if (scene.rules.start_error > 0)
            offset = origin_offset<Real>(scene.rules.start_error, places.point, places.normal);
    }
    if (hits.t != nullptr)
        store_some(hits.t + at, places.t, live);
    store_some3(hits.normal, at, places.normal, live);
    store_some3(hits.outer_start, at, places.point + offset, live);
    store_some3(hits.inner_start, at, places.point - offset, live);
    store_some3(hits.point, at, places.point, live);
}

/// The same of hits on one surface.
inline void store_common_hits(const abi::SceneView<float>& scene, const CommonHit& hit,
                              const vreal<float>& t_max, const abi::HitsView<float>& hits, int at,
                              int live)
{
    const vmask<float> found = from_bits<float>(hit.lanes);
    const vint<float> none(lane_int<float>(-1));
    const bool hits_any = hit.lanes != 0;
    const std::int32_t object = hits_any ? scene.materials.of_surface[hit.surface].object : -1;
    store_numbers<float>(hits.object + at, select(found, vint<float>(object), none), live);
    if (hits.surface != nullptr)
        store_numbers<float>(hits.surface + at,
                             select(found, vint<float>(hits_any ? hit.surface : -1), none), live);
    if (hits.t != nullptr)
        store_some(hits.t + at, select(found, hit.t, t_max), live);
    if (hits.normal[0] == nullptr)
        return;
    const vreal<float> zero(0.0f);
    const Vec3v<float> nothing{zero, zero, zero};
    const Vec3v<float> normal = select(found, hit.outward, nothing);
    const Vec3v<float> point = select(found, hit.point, nothing);
    Vec3v<float> offset = nothing;
    if (scene.rules.start_error > 0 && hits_any)
        offset = origin_offset<float>(scene.rules.start_error, point, normal);
    store_some3(hits.normal, at, normal, live);
    store_some3(hits.outer_start, at, point + offset, live);
    store_some3(hits.inner_start, at, point - offset, live);
    store_some3(hits.point, at, point, live);
}

/// Finds and stores the hits of a packet where they are on one surface (common_hit.hpp); false
/// where that can't be told. `eye` is the rays' origin where they share it.
template <Origin O>
inline bool store_if_common(const abi::SceneView<float>& scene, const CommonObjects& common,
                            const StreamPacket<float>& packet, const float (&eye)[3],
                            const abi::HitsView<float>& hits, int at)
{
    const RayPacket<float>& rays = packet.rays;
    const std::uint32_t live = first_lanes<float>(packet.count);
    const std::uint32_t fit = bits(certifiable(rays)) & bits(rays.t_min >= vreal<float>(0.0f));
    CommonHit hit;
    if ((live & ~fit) != 0 || !find_common_hit<O>(hit, common, all_of(common), rays, eye, -1, live))
        return false;
    // What ends before t_max for sure counts.
    if (hit.lanes != 0 &&
        (hit.lanes & ~bits(hit.t * vreal<float>(1.0f + 0x1p-20f) < packet.t_max)) != 0)
        return false;
    store_common_hits(scene, hit, packet.t_max, hits, at, packet.count);
    return true;
}

// What passes over a chunk is a function of its own: in one with the code around it, the compiler
// spills so much that rays took a quarter longer.

/// Where the scene has no hierarchy: packet by packet, without a bundle in between. `Starts` tells
/// whether rays may start on surfaces.
template <bool Starts, abi::Features F, class Objects, class Real>
[[gnu::noinline]] void closest_chunk_in_lists(const abi::SceneView<Real>& scene,
                                              const Objects& objects,
                                              const abi::RaysView<Real>& view, int begin, int end,
                                              const abi::HitsView<Real>& hits)
{
    for (int first = begin; first < end; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        const std::uint32_t live = first_lanes<Real>(packet.count);
        StartPacket<Real> start = no_start<Real>();
        HitPacket<Real> hit = no_hit<Real>(packet.t_max);
        if constexpr (Starts) {
            start = start_of(scene, view, first, packet.rays);
            hit = start_of_search(start, packet.t_max);
            closest_hit<F>(hit, objects, packet.rays,
                           own_with_common<Real>(start.surface, view.start_surface[first], live));
        } else {
            closest_hit<F>(hit, objects, packet.rays, NoOwn{});
        }
        settle_packet<F>(scene, packet.rays, hit, start, packet.t_max, live);
        store_packet_hits<F>(scene, packet.rays, hit, start, packet.t_max, hits, first,
                             packet.count);
    }
}

/// The same where packets may have a common hit; those that have none, and as many after them as
/// `pause` says, go through the lists.
template <abi::Features F, class Objects>
[[gnu::noinline]] void common_chunk_in_lists(const abi::SceneView<float>& scene,
                                             const Objects& objects, const CommonObjects& common,
                                             CommonPause& pause, const abi::RaysView<float>& view,
                                             int begin, int end, const abi::HitsView<float>& hits)
{
    constexpr Origin origin = Objects::shared ? Origin::shared : Origin::any;
    const float eye[3] = {view.org[0][begin], view.org[1][begin], view.org[2][begin]};
    int first = begin;
    while (first < end) {
        const int listed = first;
        for (; first < end && !pause.is_over(); first += lanes<float>) {
        }
        if (first > listed)
            closest_chunk_in_lists<false, F>(scene, objects, view, listed,
                                             first < end ? first : end, hits);
        for (bool found = true; found && first < end; first += lanes<float>) {
            found = store_if_common<origin>(scene, common, StreamPacket<float>(view, first), eye,
                                            hits, first);
            pause.record(found);
            if (!found)
                closest_chunk_in_lists<false, F>(
                    scene, objects, view, first,
                    first + lanes<float> < end ? first + lanes<float> : end, hits);
        }
    }
}

template <abi::Features F, class Real>
[[gnu::noinline]] void closest_chunk_in_tree(const abi::SceneView<Real>& scene,
                                             const StreamWork<F, Real>& work,
                                             const abi::RaysView<Real>& view, int begin, int end,
                                             const abi::HitsView<Real>& hits)
{
    RayBundle<Real>& bundle = *work.bundle;
    const int count = end - begin;
    const auto start_at = [&](int first) {
        return start_of(scene, view, begin + first, load_rays(bundle, first));
    };
    const auto t_max_at = [&](int first) {
        return load_some(view.t_max + begin + first, count - first);
    };
    for (int first = 0; first < count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, begin + first);
        const StartPacket<Real> start = start_of(scene, view, begin + first, packet.rays);
        store_rays(bundle, first, packet.rays);
        start_rays<F>(bundle, first, start_of_search(start, packet.t_max), start.surface,
                      first_lanes<Real>(count - first) & numbers(packet));
    }
    end_bundle(bundle, count);
    closest_of_bundle<F>(scene, work.nearby, bundle);
    settle_bundle<F>(scene, bundle, start_at, t_max_at);
    for (int first = 0; first < count; first += lanes<Real>)
        store_packet_hits<F>(scene, load_rays(bundle, first), load_hits(bundle, first),
                             start_at(first), t_max_at(first), hits, begin + first, count - first);
}

/// Rays that the lists are prepared for together, where there is no hierarchy to go through.
inline constexpr int list_chunk = 16 * bundle_rays;

/// Calls `visit(begin, end)` for the chunks of a stream, for which the lists are prepared.
template <abi::Features F, class Real, class Visit>
inline void for_each_chunk(StreamWork<F, Real>& work, const abi::SceneView<Real>& scene,
                           const abi::RaysView<Real>& view, const Visit& visit)
{
    const int chunk = scene.tree.empty() ? list_chunk : bundle_rays;
    for (int begin = 0; begin < view.count; begin += chunk) {
        const int end = view.count - begin < chunk ? view.count : begin + chunk;
        find_nearby_of(work, scene, view, begin, end - begin);
        visit(begin, end);
    }
}

/// The closest hits of a chunk of rays that start on no surface, where there is no hierarchy.
template <abi::Features F, class Objects, class Real>
inline void closest_chunk(const abi::SceneView<Real>& scene, StreamWork<F, Real>& work,
                          const Objects& objects, const abi::RaysView<Real>& view, int begin,
                          int end, const abi::HitsView<Real>& hits)
{
    if constexpr (F.exact)
        if (work.common.are_all)
            return common_chunk_in_lists<F>(scene, objects, work.common, work.pause, view, begin,
                                            end, hits);
    closest_chunk_in_lists<false, F>(scene, objects, view, begin, end, hits);
}

template <abi::Features F, class Real>
inline void closest_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                         const abi::HitsView<Real>& hits, void* scratch)
{
    StreamWork<F, Real> work(scratch, scene);
    work.wants_common = scene.tree.empty();
    for_each_chunk(work, scene, view, [&](int begin, int end) {
        if (!scene.tree.empty())
            closest_chunk_in_tree(scene, work, view, begin, end, hits);
        else if (work.shares_origin)
            closest_chunk(scene, work, work.from_point, view, begin, end, hits);
        else if (view.start_surface != nullptr)
            closest_chunk_in_lists<true, F>(scene, work.nearby, view, begin, end, hits);
        else
            closest_chunk(scene, work, work.nearby, view, begin, end, hits);
    });
}

template <abi::Features F, class Objects, class Real>
[[gnu::noinline]] void occluded_chunk_in_lists(const abi::SceneView<Real>& scene,
                                               const Objects& objects,
                                               const abi::RaysView<Real>& view, int begin, int end,
                                               std::uint8_t* mask)
{
    for (int first = begin; first < end; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, first);
        const std::uint32_t wanted = first_lanes<Real>(packet.count);
        const OwnSurface<vint<Real>> own{no_surface<Real>()};
        std::uint32_t blocked = 0;
        if constexpr (F.exact) {
            const Occlusion occlusion =
                occluded<F>(packet.t_max, objects, packet.rays, own, wanted);
            blocked = occlusion.blocked;
            if (occlusion.unsure != 0)
                blocked |= retrace_occluded<F>(*scene.wide, packet.rays, own.surface, packet.t_max,
                                               false, occlusion.unsure);
        } else {
            blocked =
                occluded<F>(RayEnd<Real>{packet.t_max, false}, objects, packet.rays, own, wanted);
        }
        store_mask<Real>(mask + first, blocked, packet.count);
    }
}

/// Blocks the rays of a bundle by what is in their way in double, where they are unsure. They end
/// at the bundle's `t`, which is `closed` or not (RayEnd).
template <abi::Features F>
[[gnu::noinline]] void settle_occluded(const abi::SceneView<float>& scene, RayBundle<float>& bundle,
                                       bool closed)
{
    WideBundle wide;
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t unsure = unsure_of(bundle, first) & active_lanes(bundle, first);
        if (unsure != 0)
            add_segments(wide, first, load_rays(bundle, first), load(bundle.own + first),
                         load(bundle.t + first), unsure);
    }
    if (wide.count == 0)
        return;
    block_wide<F>(*scene.wide, wide, closed, Occluders::any, [&](int ray, std::int32_t) {
        const int first = ray / lanes<float> * lanes<float>;
        finish_lanes(bundle, first, 1u << (ray - first));
        return true;
    });
}

template <abi::Features F, class Real>
[[gnu::noinline]] void occluded_chunk_in_tree(const abi::SceneView<Real>& scene,
                                              const StreamWork<F, Real>& work,
                                              const abi::RaysView<Real>& view, int begin, int end,
                                              std::uint8_t* mask)
{
    RayBundle<Real>& bundle = *work.bundle;
    const int count = end - begin;
    for (int first = 0; first < count; first += lanes<Real>) {
        const StreamPacket<Real> packet(view, begin + first);
        HitPacket<Real> none = no_hit<Real>(Real(0));
        none.t = packet.t_max;
        store_rays(bundle, first, packet.rays);
        start_rays<F>(bundle, first, none, no_surface<Real>(),
                      first_lanes<Real>(count - first) & numbers(packet));
    }
    end_bundle(bundle, count);
    std::uint16_t wanted[bundle_cells];
    for (int cell = 0; cell < bundle_cells; ++cell)
        wanted[cell] = bundle.active[cell];
    visit_occluders_of_bundle<F>(scene, work.nearby, bundle, false, EndsRays{});
    if constexpr (F.exact)
        settle_occluded<F>(scene, bundle, false);
    for (int first = 0; first < count; first += lanes<Real>) {
        const std::uint32_t before = wanted[first / cell_rays] >> first % cell_rays;
        store_mask<Real>(mask + begin + first, before & ~active_lanes(bundle, first),
                         count - first);
    }
}

template <abi::Features F, class Real>
inline void occluded_rays(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                          std::uint8_t* mask, void* scratch)
{
    StreamWork<F, Real> work(scratch, scene);
    for_each_chunk(work, scene, view, [&](int begin, int end) {
        if (!scene.tree.empty())
            occluded_chunk_in_tree(scene, work, view, begin, end, mask);
        else if (work.shares_origin)
            occluded_chunk_in_lists<F>(scene, work.from_point, view, begin, end, mask);
        else
            occluded_chunk_in_lists<F>(scene, work.nearby, view, begin, end, mask);
    });
}

/// The precision that all hits are found in: with Features::exact in double, as each of them
/// counts.
template <abi::Features F, class Real>
using SearchReal = std::conditional_t<F.exact, double, Real>;

template <abi::Features F, class Real>
inline const abi::GeometryView<SearchReal<F, Real>>& searched(const abi::SceneView<Real>& scene)
{
    if constexpr (F.exact)
        return *scene.wide;
    else
        return scene;
}

/// Fills a bundle with the rays of a stream from `begin`.
template <class Search, class Real>
inline void gather_all(const abi::RaysView<Real>& view, int begin, RayBundle<Search>& bundle)
{
    const int count = view.count - begin < bundle_rays ? view.count - begin : bundle_rays;
    for (std::uint16_t& cell : bundle.active)
        cell = 0;
    for (int ray = 0; ray < count; ++ray) {
        bool number = true;
        for (int axis = 0; axis < 3; ++axis) {
            bundle.org[axis][ray] = view.org[axis][begin + ray];
            bundle.dir[axis][ray] = view.dir[axis][begin + ray];
            number = number && bundle.org[axis][ray] == bundle.org[axis][ray] &&
                     bundle.dir[axis][ray] == bundle.dir[axis][ray];
        }
        bundle.t_min[ray] = view.t_min[begin + ray];
        bundle.t[ray] = view.t_max[begin + ray];
        number = number && bundle.t_min[ray] == bundle.t_min[ray] && bundle.t[ray] == bundle.t[ray];
        bundle.surface[ray] = bundle.own[ray] = -1;
        if (number)
            bundle.active[ray / cell_rays] |= static_cast<std::uint16_t>(1u << ray % cell_rays);
        else
            bundle.t[ray] = static_cast<Search>(-__builtin_inf());
    }
    end_bundle(bundle, count);
}

/// Hands the crossings of one surface to the sink.
template <class Search, class Real>
inline void report_hits(const abi::SceneView<Real>& scene, const RayBundle<Search>& bundle,
                        int begin, int first, const abi::HitSink<Real>& sink, std::uint32_t valid,
                        const vreal<Search>& t, std::int32_t surface)
{
    const RayPacket<Search> rays = load_rays(bundle, first);
    std::uint32_t active =
        valid & bits((t > rays.t_min) & (t < load(bundle.t + first))) & active_lanes(bundle, first);
    if (active == 0)
        return;
    const Vec3v<Search> normal = surface_normal<Search>(
        scene.shapes, scene.shapes.index[surface], madd<Search>(t, rays.dir, rays.org), rays.dir);
    alignas(64) Search ts[lanes<Search>];
    alignas(64) Search normals[3][lanes<Search>];
    store(ts, t);
    store(normals[0], normal.x);
    store(normals[1], normal.y);
    store(normals[2], normal.z);
    const std::int32_t object = scene.materials.of_surface[surface].object;
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        const Real unit_normal[3] = {static_cast<Real>(normals[0][lane]),
                                     static_cast<Real>(normals[1][lane]),
                                     static_cast<Real>(normals[2][lane])};
        sink.take(sink.context, begin + first + lane, static_cast<double>(ts[lane]), object,
                  unit_normal);
    }
}

template <abi::Features F, class Real>
inline void all_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                     const abi::HitSink<Real>& sink)
{
    using Search = SearchReal<F, Real>;
    constexpr abi::Features search = abi::with_exact(F, false);
    const abi::GeometryView<Search>& geometry = searched<F>(scene);
    RayBundle<Search> bundle;
    for (int begin = 0; begin < view.count; begin += bundle_rays) {
        gather_all(view, begin, bundle);
        const auto report = [&](int first, std::uint32_t valid, const vreal<Search>& t,
                                std::int32_t surface) {
            report_hits(scene, bundle, begin, first, sink, valid, t, surface);
        };
        for (int first = 0; first < bundle_rays; first += lanes<Search>)
            if (active_lanes(bundle, first) != 0)
                visit_all_crossings<search>(
                    geometry, load_rays(bundle, first),
                    [&](vmask<Search> valid, const vreal<Search>& t, std::int32_t surface) {
                        report(first, bits(valid), t, surface);
                    });
        if (!geometry.tree.empty())
            visit_crossings_in_tree<abi::tree_features(search)>(geometry.tree, bundle,
                                                                CrossingVisitor<Search>(report));
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
