#pragma once

#include <type_traits>

#include "kernels/shade/shade_context.hpp"
#include "kernels/stream/tile_memory.hpp"
#include "kernels/traverse/shared_origin.hpp"

// How a thread's scratch memory is divided. Sizes depend on the scene alone.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Hands out 64-byte aligned pieces of a block, or only counts them when there is none.
class Arena {
public:
    explicit Arena(void* block) : block_(static_cast<char*>(block))
    {
    }

    template <class T>
    T* take(std::size_t count)
    {
        T* piece = block_ ? reinterpret_cast<T*>(block_ + used_) : nullptr;
        used_ += (count * sizeof(T) + 63) / 64 * 64;
        return piece;
    }

    std::size_t used() const
    {
        return used_;
    }

private:
    char* block_;
    std::size_t used_ = 0;
};

template <class Real>
inline SharedOriginObjects<Real> take_candidates(Arena& arena, const abi::GeometryView<Real>& scene)
{
    const std::size_t spheres = static_cast<std::size_t>(scene.spheres.count) + abi::padding;
    SharedOriginObjects<Real> objects;
    objects.spheres.x = arena.take<Real>(spheres);
    objects.spheres.y = arena.take<Real>(spheres);
    objects.spheres.z = arena.take<Real>(spheres);
    objects.spheres.radius2 = arena.take<Real>(spheres);
    objects.spheres.constant = arena.take<Real>(spheres);
    objects.spheres.surface = arena.take<lane_int<Real>>(spheres);
    objects.anchored_spheres = arena.take<SharedOriginAnchored<Real>>(
        static_cast<std::size_t>(scene.anchored_spheres.count));
    objects.planes =
        arena.take<SharedOriginPlane<Real>>(static_cast<std::size_t>(scene.planes.count));
    objects.quadrics =
        arena.take<SharedOriginQuadric<Real>>(static_cast<std::size_t>(scene.quadrics.count));
    return objects;
}

template <bool Shared>
inline FilteredObjects<Shared> take_filters(Arena& arena, const abi::GeometryView<float>& scene)
{
    const std::size_t spheres = static_cast<std::size_t>(scene.spheres.count) + abi::padding;
    FilteredObjects<Shared> objects;
    objects.spheres.x = arena.take<float>(spheres);
    objects.spheres.y = arena.take<float>(spheres);
    objects.spheres.z = arena.take<float>(spheres);
    objects.spheres.radius2 = arena.take<float>(spheres);
    objects.spheres.bounds.outer2 = arena.take<float>(spheres);
    objects.spheres.bounds.inner2 = arena.take<float>(spheres);
    objects.spheres.bounds.along = arena.take<float>(spheres);
    objects.spheres.bounds.moment = arena.take<float>(spheres);
    objects.spheres.bounds.size = arena.take<float>(spheres);
    objects.spheres.bounds.band2 = arena.take<float>(spheres);
    objects.spheres.surface = arena.take<std::int32_t>(spheres);
    objects.anchored_spheres =
        arena.take<AnchoredFilter>(static_cast<std::size_t>(scene.anchored_spheres.count));
    objects.planes = arena.take<PlaneFilter>(static_cast<std::size_t>(scene.planes.count));
    objects.quadrics = arena.take<QuadricFilter>(static_cast<std::size_t>(scene.quadrics.count));
    return objects;
}

template <class Objects, class Real>
inline Objects take_objects(Arena& arena, const abi::GeometryView<Real>& scene)
{
    if constexpr (std::is_same_v<Objects, SharedOriginObjects<Real>>)
        return take_candidates(arena, scene);
    else if constexpr (std::is_same_v<Objects, AllObjects<Real>>)
        return {&scene};
    else
        return take_filters<Objects::shared>(arena, scene);
}

template <class Real>
inline std::size_t count_shadowed(const abi::SceneView<Real>& scene)
{
    std::size_t count = 0;
    for (int i = 0; i < scene.lights.count; ++i)
        count += scene.lights.data[i].casts_shadow ? 1 : 0;
    return count;
}

/// Streams of rays, with room for where they start if the scene wants that.
template <abi::Features F, class Real>
inline RayStream<F, Real>* take_streams(Arena& arena, const abi::SceneView<Real>& scene,
                                        std::size_t count)
{
    RayStream<F, Real>* const streams = arena.take<RayStream<F, Real>>(count);
    auto* const starts = arena.take<StartArrays<F, Real>>(scene.start_error > 0 ? count : 0);
    for (std::size_t i = 0; streams != nullptr && i < count; ++i)
        streams[i].starts = scene.start_error > 0 ? starts + i : nullptr;
    return streams;
}

/// Of what a scene does not need there is none.
template <abi::Features F, class Real>
struct Workspace {
    TileMemory<F, Real>* memory = nullptr;
    RayStream<F, Real>* streams = nullptr;  ///< of generations 1 … max_depth
    RayStream<F, Real>* refracted = nullptr;
    RayBundle<Real>* bundle = nullptr;           ///< where the scene has a hierarchy
    SurfacePacket<Real>* surfaces = nullptr;     ///< at a chunk's hits, likewise
    LightShadows<F, Real>* shadows = nullptr;    ///< of each light, likewise
    FromPoint<F, Real> visible;                  ///< from the camera
    FromAnywhere<F, Real> nearby;                ///< from a chunk's rays
    LightObjects<F, Real>* occluders = nullptr;  ///< from each light
    std::size_t bytes = 0;

    /// With no `scratch`, only `bytes` is of use.
    Workspace(void* scratch, const abi::SceneView<Real>& scene)
    {
        const std::size_t lights = static_cast<std::size_t>(scene.lights.count);
        Arena arena(scratch);
        memory = arena.take<TileMemory<F, Real>>(1);
        if constexpr (F.bounces)
            streams = take_streams<F>(arena, scene, static_cast<std::size_t>(scene.max_depth));
        if constexpr (F.glass)
            refracted = take_streams<F>(arena, scene, 1);
        const std::size_t shadowed = count_shadowed(scene);
        if (!scene.tree.empty())
            bundle = arena.take<RayBundle<Real>>(1);
        if (!scene.tree.empty() && shadowed > 0) {
            surfaces = arena.take<SurfacePacket<Real>>(chunk_rays / lanes<Real>);
            shadows = arena.take<LightShadows<F, Real>>(lights);
        }
        visible = take_objects<FromPoint<F, Real>>(arena, scene);
        nearby = take_objects<FromAnywhere<F, Real>>(arena, scene);
        if (shadowed > 0)
            occluders = arena.take<LightObjects<F, Real>>(lights);
        for (std::size_t light = 0; shadowed > 0 && light < lights; ++light) {
            const LightObjects<F, Real> objects{
                take_objects<FromPoint<F, Real>>(arena, casters_of(scene)),
                take_objects<FromAnywhere<F, Real>>(arena, casters_of(scene))};
            if (scratch != nullptr)
                occluders[light] = objects;
        }
        bytes = arena.used();
    }
};

template <abi::Features F, class Real>
inline std::size_t scratch_bytes(const abi::SceneView<Real>& scene)
{
    return Workspace<F, Real>(nullptr, scene).bytes;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
