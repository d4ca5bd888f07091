#pragma once

#include "kernels/bvh/pick_spheres.hpp"
#include "kernels/stream/camera_rays.hpp"
#include "kernels/stream/trace_stream.hpp"
#include "kernels/stream/workspace.hpp"

// Closest hits of the camera rays of a tile, without shading.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline void store_misses(abi::TileHits<Real>& hits)
{
    const HitPacket<Real> miss = no_hit<Real>(static_cast<Real>(__builtin_inf()));
    for (int first = 0; first < abi::tile_pixels; first += lanes<Real>) {
        store(hits.t + first, miss.t);
        store(hits.surface + first, miss.surface);
    }
}

/// With Features::exact each t is refined.
template <abi::Features F, class Real>
inline void store_tile_hits(abi::TileHits<Real>& hits, int first, const abi::SceneView<Real>& scene,
                            const RayPacket<Real>& rays, const HitPacket<Real>& hit)
{
    if constexpr (F.exact) {
        RefinedHits<Real, Refine::t> refined{hit.t};
        const std::uint32_t found = hit_lanes(hit);
        if (found != 0)
            refine_others(refined, scene.shapes, rays, hit.t, hit.surface, found);
        store(hits.t + first, refined.t);
    } else {
        store(hits.t + first, hit.t);
    }
    store(hits.surface + first, hit.surface);
}

/// Whether an object is in a list of objects, by the number of its first surface.
class Listed {
public:
    explicit Listed(const FilteredObjects<Origin::shared>& objects)
    {
        for_each_kind<abi::Features{.quadrics = true}>([&](auto kind) {
            const auto& list = objects_of<decltype(kind)>(objects);
            for (int i = 0; i < list.count; ++i)
                first_[count_++] = body_of(object_at(list, i)).first;
            return true;
        });
    }
    bool operator()(std::int32_t first) const
    {
        for (int i = 0; i < count_; ++i)
            if (first_[i] == first)
                return true;
        return false;
    }

private:
    std::int32_t first_[most_common_objects];
    int count_ = 0;
};

/// The objects that are visible through a tile, for scenes of few objects, where most packets hit
/// only one of them.
class CameraObjects {
public:
    CameraObjects(const abi::SceneView<float>& scene, const float (&origin)[3],
                  const FilteredObjects<Origin::shared>& visible)
        : origin_(origin)
    {
        common_.spheres.use(spheres_);
        common_.grounds.use(grounds_);
        common_.balls.use(balls_);
        if (has_few_objects(scene))
            fill_common(common_, scene, near_origins(scene, origin, origin), origin,
                        Listed(visible));
    }

    /// Finds and stores the hits of the packet at `first` if they are all on one surface. Returns
    /// false if that cannot be decided.
    bool store_hits(abi::TileHits<float>& hits, int first, const RayPacket<float>& rays) const
    {
        CommonHit hit;
        if (!common_.are_all || !all(certifiable(rays)) ||
            !find_common_hit<Refine::t, Origin::shared>(hit, common_, common_, rays, origin_, -1,
                                                        all_lanes<float>))
            return false;
        const vmask<float> found = from_bits<float>(hit.lanes);
        store(hits.t + first, select(found, hit.t, vreal<float>(__builtin_inff())));
        store(hits.surface + first,
              select(found, vint<float>(hit.lanes != 0 ? hit.surface : -1), no_surface<float>()));
        return true;
    }

private:
    const float (&origin_)[3];
    CommonObjects common_;
    CommonSphere spheres_[most_common_objects];
    CommonGround grounds_[most_common_objects];
    CommonBall balls_[most_common_objects];
};

/// The closest hits of a tile's rays with the objects of lists.
template <abi::Features F, class Objects, class Real>
inline void closest_in_tile(const abi::TileJob<Real>& job, abi::TileHits<Real>& hits,
                            const Objects& visible)
{
    const abi::SceneView<Real>& scene = *job.scene;
    const TileCamera<Real> camera(job);
    const vreal<Real> never(static_cast<Real>(__builtin_inf()));
    const auto find = [&](int first, const RayPacket<Real>& rays) {
        HitPacket<Real> hit = no_hit<Real>(never);
        closest_hit<F>(hit, visible, rays, NoOwn{});
        correct_packet<F>(scene, rays, hit, no_start<Real>(), never, all_lanes<Real>);
        store_tile_hits<F>(hits, first, scene, rays, hit);
    };
    const auto packet = [&](int first) { return camera_rays(camera, first, scene.rules.units); };
    if constexpr (F.exact) {
        const CameraObjects common(scene, job.camera->origin, visible);
        for (int first = 0; first < abi::tile_pixels; first += lanes<Real>)
            if (!common.store_hits(hits, first, packet(first)))
                find(first, packet(first));
    } else {
        for (int first = 0; first < abi::tile_pixels; first += lanes<Real>)
            find(first, packet(first));
    }
}

template <abi::Features F, class Real>
inline void closest_tile(const abi::TileJob<Real>& job, abi::TileHits<Real>& hits)
{
    const abi::SceneView<Real>& scene = *job.scene;
    Arena arena(job.scratch);
    FromPoint<F, Real> visible;
    take_objects<F>(arena, visible, scene);
    const Cone<Real> cone = camera_cone(job);
    find_objects<F>(visible, cone, scene);
    const bool are_all = picks_all<F>(visible, cone, scene);
    sort_by_distance<F>(visible);
    if (!are_all) {
        auto& bundle = *take_bundle<F, Real>(arena);
        gather_camera<F>(job, bundle);
        closest_of_bundle<F>(scene, visible, bundle);
        correct_camera_bundle<F>(scene, bundle);
        for (int first = 0; first < abi::tile_pixels; first += lanes<Real>)
            store_tile_hits<F>(hits, first, scene, load_rays(bundle, first),
                               load_hits(bundle, first));
        return;
    }
    if (visible.empty()) {
        store_misses(hits);
        return;
    }
    closest_in_tile<F>(job, hits, visible);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
