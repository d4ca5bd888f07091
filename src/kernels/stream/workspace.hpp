#pragma once

#include "kernels/bvh/leaf_filters.hpp"
#include "kernels/lists/object_sets.hpp"
#include "kernels/shade/shade_context.hpp"
#include "kernels/stream/sort_rays.hpp"
#include "kernels/stream/tile_memory.hpp"

// How a thread's scratch memory is divided. Sizes depend on the scene and on how many tiles are
// rendered together.
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

/// A bundle, with room for what it keeps.
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

/// Streams of rays, with room for where they start if the scene wants that.
template <abi::Features F, class Real>
inline RayStream<F, Real>* take_streams(Arena& arena, const abi::SceneView<Real>& scene,
                                        std::size_t count)
{
    RayStream<F, Real>* const streams = arena.take<RayStream<F, Real>>(count);
    auto* const starts = arena.take<StartArrays<F, Real>>(scene.rules.start_error > 0 ? count : 0);
    for (std::size_t i = 0; streams != nullptr && i < count; ++i)
        streams[i].starts = scene.rules.start_error > 0 ? starts + i : nullptr;
    return streams;
}

/// Room for what may stand between one light and hits.
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

/// Of what a scene does not need there is none.
template <abi::Features F, class Real>
struct Workspace {
    TileMemory<F, Real>* memory = nullptr;
    /// Of generations 1 … max_depth; of several tiles one, for a chunk of sorted rays.
    RayStream<F, Real>* streams = nullptr;
    SortedWork<F, Real>* sorted = nullptr;  ///< of several tiles
    RayStream<F, Real>* refracted = nullptr;
    RayBundle<Real>* bundle = nullptr;           ///< where the scene has a hierarchy
    SurfacePacket<Real>* surfaces = nullptr;     ///< at a chunk's hits, likewise
    LightShadows<F, Real>* shadows = nullptr;    ///< of each light, likewise
    FromPoint<F, Real> visible;                  ///< from the camera
    FromAnywhere<F, Real> nearby;                ///< from a chunk's rays
    LightObjects<F, Real>* occluders = nullptr;  ///< from each light
    double* lacks = nullptr;                     ///< ShadeContext::lacks, of all tiles
    std::size_t bytes = 0;

    /// With no `scratch`, only `bytes` is of use.
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

    void take_all_occluders(Arena& arena, const abi::SceneView<Real>& scene, bool has_room)
    {
        LightObjects<F, Real> measured;
        for (int i = 0; i < scene.lighting.lights.count; ++i)
            take_occluders<F, Real>(arena, has_room ? occluders[i] : measured, scene,
                                    scene.lighting.lights.data[i]);
    }
};

/// Enough for so many tiles together, and for fewer: one alone has a stream for each generation,
/// which deep scenes need more for than for some tiles.
template <abi::Features F, class Real>
inline std::size_t scratch_bytes(const abi::SceneView<Real>& scene, int tiles)
{
    const std::size_t alone = Workspace<F, Real>(nullptr, scene, 1).bytes;
    const std::size_t together = Workspace<F, Real>(nullptr, scene, tiles).bytes;
    return alone > together ? alone : together;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
