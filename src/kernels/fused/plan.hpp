#pragma once

#include "kernels/lists/common_hit.hpp"
#include "kernels/lists/object_sets.hpp"
#include "kernels/stream/workspace.hpp"

#include <limits>

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
    BorrowedList<const FrontPlane*> planes;
    BorrowedList<const AcrossSphere*> across;
    BorrowedList<const ConeSphere*> cones;
};

/// What can be told of shadow rays without an interval (clear_way.hpp), of points in the plan's
/// `origins`.
struct ClearTests {
    BorrowedList<FrontPlane> planes;
    BorrowedList<AcrossSphere> across;  ///< of a directional light
    BorrowedList<ConeSphere> cones;     ///< of a point light
    float axis[2][3] = {};              ///< of the plane across a directional light
    float length2 = 0;                  ///< of its vector, and the inverse root
    float inverse_length = 0;
    float least_distance2 = 0;  ///< points nearer to a point light than its root are not told of
    NeededTests* needed = nullptr;  ///< by surface; [-1] for points on any
    bool complete = false;          ///< these tests know all objects that may be in the way
};

struct PlanLight {
    abi::LightRecord<float> record;
    int number;
    ClearTests clear;
};

/// A material in all lanes.
struct PlanMaterial {
    MaterialPacket<float> packet;
    vreal<float> floor2;  ///< squared cosine below which nothing shines, less what rounding may do
    bool mirrors;
};

struct PlanSurface {
    const PlanMaterial* material = nullptr;  ///< null where hits have more than one
    bool met_again = false;                  ///< rays that leave it outside may meet its body again
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
    BorrowedList<PlanLight> lights;               ///< by number
    CommonObjects common;                         ///< likewise from `origins`
    PlanMaterial* materials = nullptr;            ///< by number
    PlanSurface* surfaces = nullptr;              ///< by number; [-1] for hits on several
    std::size_t bytes = 0;

    /// With no `memory`, only `bytes` is of use.
    FramePlan(void* memory, const abi::SceneView<float>& scene)
    {
        const abi::SceneView<float>& casters = casters_of(scene);
        const auto light_count = static_cast<std::size_t>(scene.lighting.lights.count);
        Arena arena(memory);
        arena.take<FramePlan>(1);
        take_objects<F>(arena, from_camera, scene);
        take_objects<F>(arena, from_near, scene);
        common.take(arena, scene);
        materials = arena.take<PlanMaterial>(material_count(scene));
        surfaces = arena.take<PlanSurface>(1 + surface_count(scene));
        if (memory != nullptr)
            ++surfaces;
        occluders = arena.take<LightObjects<F, float>>(light_count);
        lights.take(arena, light_count);
        LightObjects<F, float> measured;
        for (std::size_t i = 0; i < light_count; ++i) {
            take_occluders<F, float>(arena, memory != nullptr ? occluders[i] : measured, scene,
                                     scene.lighting.lights.data[i]);
            take_clear(arena, memory != nullptr ? &(lights.next() = {}).clear : nullptr,
                       scene.lighting.lights.data[i], casters, scene);
        }
        bytes = arena.used();
    }

private:
    static void take_clear(Arena& arena, ClearTests* tests, const abi::LightRecord<float>& light,
                           const abi::SceneView<float>& casters, const abi::SceneView<float>& scene)
    {
        const bool is_point = light.kind == abi::LightKind::point;
        const auto balls = static_cast<std::size_t>(casters.spheres.count + casters.quadrics.count +
                                                    casters.polygons.count);
        const auto flats =
            static_cast<std::size_t>(casters.planes.count + casters.anchored_spheres.count);
        const auto take_all = [&](auto& of) {
            of.planes.take(arena, flats);
            of.across.take(arena, is_point ? 0 : balls);
            of.cones.take(arena, is_point ? balls : 0);
        };
        const std::size_t surfaces = 1 + surface_count(scene);
        ClearTests measured;
        take_all(tests != nullptr ? *tests : measured);
        NeededTests* const needed = arena.take<NeededTests>(surfaces);
        if (tests != nullptr)
            tests->needed = needed + 1;
        NeededTests none;
        for (std::size_t i = 0; i < surfaces; ++i)
            take_all(tests != nullptr ? needed[i] : none);
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
