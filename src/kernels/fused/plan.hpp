#pragma once

#include "kernels/lists/common_hit.hpp"
#include "kernels/lists/object_sets.hpp"
#include "kernels/stream/workspace.hpp"

#include <limits>

// The data shared by the tiles of a frame that is traced in registers (fused_tile.hpp): the objects
// with their error bounds for camera rays, for rays from around the bounded objects, and for shadow
// rays. It is made once per frame, and tiles only read it.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A plane that has a light in front of it and an object behind it. The segment from the light to a
/// point with normal·point > offset does not hit the object.
struct FrontPlane {
    float normal[3];
    float offset;
    std::int32_t behind;  ///< surface of the object
};

/// A sphere, or a bounding ball of another object, for a directional light. In the plane
/// perpendicular to the light, the line from a point to the light misses it if it passes further
/// from `center` than the root of `outer2`.
struct AcrossSphere {
    float center[2];  ///< in that plane
    float outer2;
    float inner2;  ///< lines that pass closer hit the sphere; negative for a bounding ball
    float along;   ///< points beyond this along the light are past the sphere
    float before;  ///< points before this along the light have the whole sphere ahead
    Body body;
};

/// The same for a point light. The segment from the light to a point misses the ball if the cosine
/// between it and `to` is less than `edge` over the length of `to`.
struct ConeSphere {
    float to[3];       ///< from the light to the centre
    float edge;        ///< -infinite if the light is not outside
    float inner_edge;  ///< above this the segment hits the sphere; infinite for a bounding ball
    float center[3];
    float outer2;
    Body body;
};

/// The tests of a light that points on one surface need: no point of the surface can fail the
/// others.
struct NeededTests {
    BorrowedList<const FrontPlane*> planes;
    BorrowedList<const AcrossSphere*> across;
    BorrowedList<const ConeSphere*> cones;
};

/// The quick tests for shadow rays (clear_way.hpp), for points within the plan's `origins`.
struct ClearTests {
    BorrowedList<FrontPlane> planes;
    BorrowedList<AcrossSphere> across;  ///< for a directional light
    BorrowedList<ConeSphere> cones;     ///< for a point light
    float axis[2][3] = {};              ///< axes of the plane perpendicular to a directional light
    float length2 = 0;  ///< squared length of its vector, and below the inverse length
    float inverse_length = 0;
    /// Squared distance; points closer to a point light are not decided.
    float least_distance2 = 0;
    NeededTests* needed = nullptr;  ///< by surface; [-1] for points on any
    bool complete = false;          ///< the tests include all possible occluders
};

struct PlanLight {
    abi::LightRecord<float> record;
    int number;
    ClearTests clear;
};

/// A material in all lanes.
struct PlanMaterial {
    MaterialPacket<float> packet;
    /// Squared cosine below which there is no highlight, reduced by rounding errors.
    vreal<float> floor2;
    bool reflects;
};

struct PlanSurface {
    const PlanMaterial* material = nullptr;  ///< null if hits may have several
    bool met_again = false;  ///< rays that leave it on the outer side may hit its object again
};

/// PlanMaterial::floor2: rounding cannot give a highlight to a cosine below its root.
inline vreal<float> shine_floor2(const MaterialPacket<float>& material)
{
    const vreal<float> floor = material.highlight_floor;
    return max(floor * floor * vreal<float>(1.0f - 0x1p-18f),
               vreal<float>(std::numeric_limits<float>::min()));
}

/// Whether each tile has its own list of the objects that its camera rays may hit; else they are
/// tested against all objects of the plan. Such a list with error bounds takes long to make, and
/// pays only if tests are expensive.
template <abi::Features F>
inline constexpr bool lists_by_tile = F.quadrics || !F.exact;

/// `F` is a feature set without glass.
template <abi::Features F>
struct FramePlan {
    FromPoint<F, float> from_camera;   ///< only in exact mode
    FromAnywhere<F, float> from_near;  ///< in exact mode for rays from `origins`, else for all
    Origins origins;
    /// By light; for a light that sends no rays, for rays from `origins`.
    LightObjects<F, float>* occluders = nullptr;
    BorrowedList<PlanLight> lights;     ///< by light number
    CommonObjects common;               ///< for rays from `origins`; only in exact mode are_all
    PlanMaterial* materials = nullptr;  ///< by material number
    PlanSurface* surfaces = nullptr;    ///< by number; [-1] for hits on several surfaces
    std::size_t bytes = 0;

    /// With a null `memory`, only `bytes` is valid.
    FramePlan(void* memory, const abi::SceneView<float>& scene)
    {
        const abi::SceneView<float>& casters = casters_of(scene);
        const auto light_count = static_cast<std::size_t>(scene.lighting.lights.count);
        Arena arena(memory);
        arena.take<FramePlan>(1);
        if constexpr (F.exact)
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
    /// Calls `visit(surface)` for each surface.
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
    /// One more than the largest surface number.
    static std::size_t surface_count(const abi::SceneView<float>& scene)
    {
        std::int32_t most = -1;
        for_each_surface(scene,
                         [&](std::int32_t surface) { most = most < surface ? surface : most; });
        return static_cast<std::size_t>(most) + 1;
    }

public:
    /// One more than the largest material number of these surfaces.
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
