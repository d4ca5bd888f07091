#pragma once

#include "kernels/bvh/leaf_filters.hpp"
#include "kernels/lists/object_sets.hpp"
#include "kernels/shade/shade_context.hpp"
#include "kernels/stream/sort_rays.hpp"
#include "kernels/stream/tile_memory.hpp"

// The layout of a thread's scratch memory. Sizes depend on the scene and on the number of tiles
// that are rendered together.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Allocates 64-byte aligned pieces of a block; without a block it only measures.
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

/// Takes memory for a bundle and for the bounds that it keeps.
template <abi::Features F, class Real>
inline RayBundle<Real>* take_bundle(Arena& arena)
{
    RayBundle<Real>* const bundle = arena.take<RayBundle<Real>>(1);
    if constexpr (F.exact) {
        auto* const filters = arena.take<LeafFilters>(1);
        if (bundle != nullptr) {
            bundle->filters = filters;
            filters->begin(nullptr);
        }
    }
    return bundle;
}

template <class Real>
inline std::size_t count_shadowed(const abi::SceneView<Real>& scene)
{
    std::size_t count = 0;
    for (int i = 0; i < scene.lighting.lights.count; ++i)
        count += scene.lighting.lights.data[i].casts_shadow ? 1 : 0;
    return count;
}

/// Takes memory for streams of rays, and for their starts if the scene needs them.
template <abi::Features F, class Real>
inline RayStream<F, Real>* take_streams(Arena& arena, const abi::SceneView<Real>& scene,
                                        std::size_t stream_count)
{
    RayStream<F, Real>* const streams = arena.take<RayStream<F, Real>>(stream_count);
    auto* const starts =
        arena.take<StartArrays<F, Real>>(scene.rules.start_error > 0 ? stream_count : 0);
    for (std::size_t i = 0; streams != nullptr && i < stream_count; ++i)
        streams[i].starts = scene.rules.start_error > 0 ? starts + i : nullptr;
    return streams;
}

/// Takes memory for the possible occluders between one light and hits.
template <abi::Features F, class Real>
inline void take_occluders(Arena& arena, LightObjects<F, Real>& objects,
                           const abi::SceneView<Real>& scene, const abi::LightRecord<Real>& light)
{
    if (!light.casts_shadow)
        return;
    if (light.sends_rays)
        take_objects<F>(arena, objects.from_point, casters_of(scene));
    else
        take_objects<F>(arena, objects.along, casters_of(scene));
}

/// The working memory of a thread. Parts that a scene does not need are null.
template <abi::Features F, class Real>
struct Workspace {
    TileMemory<F, Real>* memory = nullptr;
    /// For one tile: the streams of generations 1 … max_depth. For several tiles: one stream, for a
    /// chunk of sorted rays.
    RayStream<F, Real>* streams = nullptr;
    SortedWork<F, Real>* sorted = nullptr;  ///< for several tiles
    RayStream<F, Real>* refracted = nullptr;
    RayBundle<Real>* bundle = nullptr;           ///< only with a BVH
    SurfacePacket<Real>* surfaces = nullptr;     ///< at a chunk's hits; only with a BVH and shadows
    LightShadows<F, Real>* shadows = nullptr;    ///< per light; only with a BVH and shadows
    FromPoint<F, Real> visible;                  ///< objects visible from the camera
    FromAnywhere<F, Real> nearby;                ///< objects near a chunk's rays
    LightObjects<F, Real>* occluders = nullptr;  ///< per light
    double* lacks = nullptr;                     ///< ShadeContext::lacks, for all tiles
    std::size_t bytes = 0;

    /// With a null `scratch`, only `bytes` is valid.
    Workspace(void* scratch, const abi::SceneView<Real>& scene, int tiles)
    {
        const std::size_t lights = static_cast<std::size_t>(scene.lighting.lights.count);
        const std::size_t tile_count = static_cast<std::size_t>(tiles);
        Arena arena(scratch);
        memory = arena.take<TileMemory<F, Real>>(1);
        Real* const color = arena.take<Real>(tile_elements * tile_count);
        if (memory != nullptr)
            memory->color = color;
        take_generations(arena, scene, tile_count);
        if constexpr (F.glass)
            refracted = take_streams<F>(arena, scene, 1);
        if (scene.rules.min_weight > 0)
            lacks = arena.take<double>(abi::tile_pixels * tile_count);
        const std::size_t shadowed = count_shadowed(scene);
        if (!scene.tree.empty())
            bundle = take_bundle<F, Real>(arena);
        if (!scene.tree.empty() && shadowed > 0) {
            surfaces = arena.take<SurfacePacket<Real>>(chunk_rays / lanes<Real>);
            shadows = arena.take<LightShadows<F, Real>>(lights);
        }
        take_objects<F>(arena, visible, scene);
        if (scene.rules.max_depth > 0)
            take_objects<F>(arena, nearby, scene);
        if (shadowed > 0) {
            occluders = arena.take<LightObjects<F, Real>>(lights);
            take_all_occluders(arena, scene, scratch != nullptr);
        }
        bytes = arena.used();
    }

private:
    void take_generations(Arena& arena, const abi::SceneView<Real>& scene, std::size_t tiles)
    {
        if (tiles == 1) {
            streams =
                take_streams<F>(arena, scene, static_cast<std::size_t>(scene.rules.max_depth));
            return;
        }
        streams = take_streams<F>(arena, scene, 1);
        sorted = arena.take<SortedWork<F, Real>>(1);
        for (int generation = 0; generation < 2; ++generation) {
            auto* const of_chunks = take_streams<F>(arena, scene, tiles);
            if (sorted != nullptr)
                sorted->streams[generation] = of_chunks;
        }
    }

    void take_all_occluders(Arena& arena, const abi::SceneView<Real>& scene, bool has_memory)
    {
        LightObjects<F, Real> measured;
        for (int i = 0; i < scene.lighting.lights.count; ++i)
            take_occluders<F, Real>(arena, has_memory ? occluders[i] : measured, scene,
                                    scene.lighting.lights.data[i]);
    }
};

/// Enough memory for `tiles` tiles together and for fewer. One tile alone has a stream per
/// generation, which in deep scenes needs more memory than a few tiles together.
template <abi::Features F, class Real>
inline std::size_t scratch_bytes(const abi::SceneView<Real>& scene, int tiles)
{
    const std::size_t alone = Workspace<F, Real>(nullptr, scene, 1).bytes;
    const std::size_t together = Workspace<F, Real>(nullptr, scene, tiles).bytes;
    return alone > together ? alone : together;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
