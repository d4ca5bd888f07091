#pragma once

#include "kernel_abi/ray_streams.hpp"
#include "kernels/lists/common_hit.hpp"
#include "kernels/simd/stream_values.hpp"
#include "kernels/stream/pending_hits.hpp"

#include <limits>

// Writes the closest hits of rays from the caller into the caller's arrays.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The object numbers of the lanes of `active`. The other lanes keep their surface numbers.
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

/// The point and normal of rays that hit nothing.
template <class Real>
inline Vec3v<Real> nowhere()
{
    const vreal<Real> no_number(std::numeric_limits<Real>::quiet_NaN());
    return {no_number, no_number, no_number};
}
template <class Real>
inline Vec3v<Real> no_normal()
{
    const vreal<Real> zero(Real(0));
    return {zero, zero, zero};
}

/// Writes points and normals, and points offset to either side of the surface, where the scene asks
/// for offsets and `any` ray has a hit.
template <class Real>
inline void store_points(const abi::SceneView<Real>& scene, const Vec3v<Real>& point,
                         const Vec3v<Real>& normal, bool any, const abi::HitsView<Real>& hits,
                         int at, int live)
{
    const vreal<Real> zero(Real(0));
    Vec3v<Real> offset{zero, zero, zero};
    if (any && scene.rules.start_error > 0)
        offset = origin_offset<Real>(scene.rules.start_error, point, normal);
    store_some3(hits.normal, at, normal, live);
    store_some3(hits.outer_start, at, point + offset, live);
    store_some3(hits.inner_start, at, point - offset, live);
    store_some3(hits.point, at, point, live);
}

/// Writes t, points and normals of a packet of which `live` rays are left. It is not inlined, as
/// few callers ask for points.
template <abi::Features F, class Real>
[[gnu::noinline]] void store_places(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                                    const HitPacket<Real>& hit, const StartPacket<Real>& start,
                                    const vreal<Real>& t_max, const abi::HitsView<Real>& hits,
                                    int at, int live)
{
    const auto missed = int_equal(hit.surface, no_surface<Real>());
    const std::uint32_t found = ~bits(missed) & first_lanes<Real>(live);
    RefinedHits<Real> places{t_max, nowhere<Real>(), no_normal<Real>()};
    if (found != 0) {
        places = refined<F, Refine::place>(scene.shapes, rays, hit, start, found);
        places.t = select(missed, t_max, places.t);
        places.point = select(missed, nowhere<Real>(), places.point);
        places.normal = select(missed, no_normal<Real>(), places.normal);
    }
    if (hits.t != nullptr)
        store_some(hits.t + at, places.t, live);
    store_points(scene, places.point, places.normal, found != 0, hits, at, live);
}

/// Writes the hits of a packet whose rays all hit the same surface or nothing.
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
                             select(found, vint<float>(hit.surface), vint<float>(abi::no_start)),
                             live);
    if (hits.t != nullptr)
        store_some(hits.t + at, select(found, hit.t, t_max), live);
    if (hits.normal[0] == nullptr)
        return;
    store_points<float>(scene, select(found, hit.point, nowhere<float>()),
                        select(found, hit.outward, no_normal<float>()), hits_any, hits, at, live);
}

/// Writes the closest hits of a stream.
template <abi::Features F, class Real>
class HitWriter {
public:
    HitWriter(const abi::SceneView<Real>& scene, const abi::HitsView<Real>& hits)
        : scene_(scene), hits_(hits), pending_(scene.shapes, hits.t)
    {
    }

    /// Whether the caller asks for points and normals, not only for t.
    [[nodiscard]] bool asks_for_places() const
    {
        return hits_.normal[0] != nullptr;
    }

    /// Writes the hits of a packet, of which `live` rays are left, from index `at` on.
    void store_hits(const RayPacket<Real>& rays, const HitPacket<Real>& hit,
                    const StartPacket<Real>& start, const vreal<Real>& t_max, int at, int live)
    {
        const auto missed = int_equal(hit.surface, no_surface<Real>());
        const std::uint32_t found = ~bits(missed) & first_lanes<Real>(live);
        store_numbers<Real>(hits_.object + at, objects_of(scene_, hit.surface, found), live);
        if (hits_.surface != nullptr)
            store_numbers<Real>(
                hits_.surface + at,
                select(missed, vint<Real>(lane_int<Real>{abi::no_start}), hit.surface), live);
        if (asks_for_places())
            store_places<F>(scene_, rays, hit, start, t_max, hits_, at, live);
        else if (hits_.t != nullptr)
            store_t(rays, hit, start, select(missed, t_max, hit.t), found, at, live);
    }

    /// The same for hits that are all on one surface.
    void store_hits(const CommonHit& hit, const vreal<float>& t_max, int at, int live)
    {
        store_common_hits(scene_, hit, t_max, hits_, at, live);
    }

    /// Refines and writes the hits that still wait. Call it at the end.
    void finish()
    {
        if constexpr (F.exact)
            pending_.finish();
    }

private:
    /// `t` is the t that the search found, and t_max for misses.
    void store_t(const RayPacket<Real>& rays, const HitPacket<Real>& hit,
                 const StartPacket<Real>& start, const vreal<Real>& t, std::uint32_t found, int at,
                 int live)
    {
        Real* const to = hits_.t + at;
        if constexpr (!F.exact) {
            store_some(to, t, live);
        } else if (PendingHits<F, Real>::is_worth_it(found)) {
            const auto again = int_equal(hit.surface, start.second.surface);
            store_some(to, select(from_bits<Real>(bits(again) & found), start.second.t, t), live);
            pending_.add(rays, hit, found & ~bits(again), at);
        } else {
            const vmask<Real> hits = from_bits<Real>(found);
            const vreal<Real> better =
                refined<F, Refine::t>(scene_.shapes, rays, hit, start, found).t;
            store_some(to, select(hits, better, t), live);
        }
    }

    const abi::SceneView<Real>& scene_;
    const abi::HitsView<Real>& hits_;
    PendingHits<F, Real> pending_;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
