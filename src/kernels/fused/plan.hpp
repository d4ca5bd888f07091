#pragma once

#include <limits>

#include "kernels/stream/workspace.hpp"
#include "kernels/traverse/common_hit.hpp"
#include "kernels/traverse/object_sets.hpp"

// What the tiles of a frame share that is traced in registers (fused_tile.hpp): the objects with
// their error bounds, for camera rays, for rays from around the bounded objects, and for shadow
// rays. It is made once a frame; tiles only read it.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A plane that a light is in front of, and an object behind: the way from the light to a point
/// that is in front of it by more than `offset` is clear of the object.
struct FrontPlane {
    float normal[3];
    float offset;
    std::int32_t behind;  ///< the object's surface
};

/// A sphere, or a ball around an object, that a directional light misses where its line through a
/// point passes further off than the root of `outer2`, in the plane across the light.
struct AcrossSphere {
    float center[2];  ///< in that plane
    float outer2;
    float inner2;  ///< lines that pass nearer cross it; negative for a ball around another object
    float along;   ///< points further on than this are past the sphere
    float before;  ///< points less far on have it all before them
    Body body;
};

/// The same that the way from a point light misses whose cosine with the way to the sphere, `to`,
/// is less than `edge` over its length.
struct ConeSphere {
    float to[3];  ///< from the light to the centre
    float edge;   ///< -infinite for a light that is not outside
    float
        inner_edge;  ///< what is more crosses the sphere; infinite for a ball around another object
    float center[3];
    float outer2;
    Body body;
};

/// Which of a light's tests points on one surface need: the others can't fail for any point of it.
struct NeededTests {
    std::uint8_t* planes = nullptr;
    std::uint8_t* spheres = nullptr;
    int plane_count = 0;
    int sphere_count = 0;
};

/// What can be told of shadow rays without an interval (clear_way.hpp), of points in the plan's
/// `origins`.
struct ClearTests {
    const FrontPlane* planes = nullptr;
    const AcrossSphere* across = nullptr;  ///< of a directional light
    const ConeSphere* cones = nullptr;     ///< of a point light
    int plane_count = 0;
    int sphere_count = 0;
    float axis[2][3] = {};  ///< of the plane across a directional light
    float length2 = 0;      ///< of its vector, and the inverse root
    float inverse_length = 0;
    float least_distance2 = 0;  ///< points nearer to a point light than its root are not told of
    NeededTests* needed = nullptr;  ///< by surface; [-1] for points on any
    bool complete = false;          ///< these tests know all objects that may be in the way
};

/// A material in all lanes.
struct PlanMaterial {
    MaterialPacket<float> packet;
    vreal<float> floor2;  ///< squared cosine below which nothing shines, less what rounding may do
    bool mirrors;
};

/// PlanMaterial::floor2: rounding can't make a shine of a cosine that is below its root.
inline vreal<float> shine_floor2(const MaterialPacket<float>& material)
{
    const vreal<float> floor = material.highlight_floor;
    return max(floor * floor * vreal<float>(1.0f - 0x1p-18f),
               vreal<float>(std::numeric_limits<float>::min()));
}

/// `F` is a feature set of exact mode without glass.
template <abi::Features F>
struct FramePlan {
    FilteredObjects<true> from_camera;
    FilteredObjects<false> from_near;  ///< from `origins`
    Origins origins;
    LightObjects<F, float>* occluders = nullptr;  ///< by light; if it sends no rays from `origins`
    ClearTests* clear = nullptr;                  ///< by light
    CommonObjects common;                         ///< likewise from `origins`
    PlanMaterial* materials = nullptr;            ///< by number
    /// By surface, whether rays that leave it outside may meet its body again; [-1]: of any.
    bool* met_again = nullptr;
    std::size_t bytes = 0;

    /// With no `memory`, only `bytes` is of use.
    FramePlan(void* memory, const abi::SceneView<float>& scene)
    {
        const abi::SceneView<float>& casters = casters_of(scene);
        const int lights = scene.lighting.lights.count;
        Arena arena(memory);
        arena.take<FramePlan>(1);
        take_objects<F>(arena, from_camera, scene);
        take_objects<F>(arena, from_near, scene);
        common.take(arena, scene);
        materials = arena.take<PlanMaterial>(material_count(scene));
        met_again = arena.take<bool>(1 + surface_count(scene));
        if (memory != nullptr)
            ++met_again;
        occluders = arena.take<LightObjects<F, float>>(static_cast<std::size_t>(lights));
        clear = arena.take<ClearTests>(static_cast<std::size_t>(lights));
        LightObjects<F, float> measured;
        for (int i = 0; i < lights; ++i) {
            take_occluders<F, float>(arena, memory != nullptr ? occluders[i] : measured, scene,
                                     scene.lighting.lights.data[i]);
            take_clear(arena, memory != nullptr ? clear + i : nullptr, casters, scene);
        }
        bytes = arena.used();
    }

private:
    static void take_clear(Arena& arena, ClearTests* tests, const abi::SceneView<float>& casters,
                           const abi::SceneView<float>& scene)
    {
        const auto spheres = static_cast<std::size_t>(
            casters.spheres.count + casters.quadrics.count + casters.polygons.count);
        const auto flats =
            static_cast<std::size_t>(casters.planes.count + casters.anchored_spheres.count);
        const std::size_t surfaces = 1 + surface_count(scene);
        FrontPlane* const planes = arena.take<FrontPlane>(flats);
        AcrossSphere* const across = arena.take<AcrossSphere>(spheres);
        ConeSphere* const cones = arena.take<ConeSphere>(spheres);
        NeededTests* const needed = arena.take<NeededTests>(surfaces);
        std::uint8_t* const numbers = arena.take<std::uint8_t>(surfaces * (flats + spheres));
        if (tests == nullptr)
            return;
        *tests = {};
        tests->planes = planes;
        tests->across = across;
        tests->cones = cones;
        tests->needed = needed + 1;
        for (std::size_t i = 0; i < surfaces; ++i) {
            needed[i].planes = numbers + i * (flats + spheres);
            needed[i].spheres = needed[i].planes + flats;
        }
    }

public:
    /// Calls `visit(surface)` for each.
    template <class Visit>
    static void for_each_surface(const abi::SceneView<float>& scene, const Visit& visit)
    {
        for_each_kind<F>([&](auto kind) {
            const auto& list = kind.list(scene);
            for (int i = 0; i < list.count; ++i) {
                const Body body = body_of(object_at(list, i));
                for (int piece = 0; piece < body.pieces; ++piece)
                    visit(body.first + piece);
            }
            return true;
        });
    }

private:
    /// One more than the largest number.
    static std::size_t surface_count(const abi::SceneView<float>& scene)
    {
        std::int32_t most = -1;
        for_each_surface(scene,
                         [&](std::int32_t surface) { most = most < surface ? surface : most; });
        return static_cast<std::size_t>(most) + 1;
    }

public:
    /// One more than the largest number of a material of these surfaces.
    static std::size_t material_count(const abi::SceneView<float>& scene)
    {
        std::int32_t count = 0;
        for_each_surface(scene, [&](std::int32_t surface) {
            const abi::MaterialIndex& index = scene.materials.of_surface[surface];
            const std::int32_t last = index.checker < 0 ? index.first : index.first + 1;
            count = count <= last ? last + 1 : count;
        });
        return static_cast<std::size_t>(count);
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
