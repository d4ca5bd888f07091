#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/beam.hpp"
#include "kernels/stiff_quadratic.hpp"

// The list of a scene's stiff objects, and what of it a tile's beam can meet.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A sphere seen from an origin that all rays share.
struct SharedOriginStiffSphere {
    double o[3];
    double radius2;
    double constant;
};

inline Quadratic<double> quadratic_of(const SharedOriginStiffSphere& sphere,
                                      const RayPacket<double>& rays)
{
    return sphere_quadratic<double>(rays, broadcast(sphere.o), vreal<double>(sphere.radius2),
                                    vreal<double>(sphere.constant));
}

inline SharedOriginStiffSphere share_origin(const abi::StiffSphere& sphere,
                                            const Vec3v<double>& origin)
{
    const Vec3v<double> o = origin - broadcast(sphere.center);
    const vreal<double> radius2(sphere.radius2);
    return {{first_lane<double>(o.x), first_lane<double>(o.y), first_lane<double>(o.z)},
            sphere.radius2,
            first_lane<double>(sphere_constant<double>(o, radius2))};
}

/// A stiff object seen from an origin that all rays share; the part of its kind is set.
struct SharedOriginStiff {
    const abi::StiffObject* object;
    SharedOriginStiffSphere sphere;
    SharedOriginHuge<double> huge;
    SharedOriginPlane<double> plane;
    SharedOriginQuadric<double> quadric;
};

/// Lanes that surely miss the ball around an object, by float's own margin: |o × d|² is then
/// more than |d|² (r² + 4 u (|o|² + |c|²)); docs/numerics.md has the proof. The constant keeps
/// away from where squares lose their digits to underflow.
inline vmask<float> pass_by(const abi::StiffObject& object, const RayPacket<float>& rays)
{
    constexpr float four_roundoffs = 4.0f * 0x1p-24f;
    constexpr float smallest = 1e-30f;
    const Vec3v<float> o = rays.org - broadcast(object.bound);
    const Vec3v<float> moment = cross(o, rays.dir);
    const vreal<float> size =
        madd(vreal<float>(four_roundoffs), dot(o, o), vreal<float>(object.bound_radius2));
    return dot(moment, moment) > madd(rays.dir2, size, vreal<float>(smallest));
}

/// Calls `test(visit)` unless all lanes pass the ball by; those that do meet nothing even where
/// their neighbours make the test necessary.
template <class Visit, class Test>
inline void visit_near(const abi::StiffObject& object, const RayPacket<float>& rays,
                       const Visit& visit, const Test& test)
{
    const std::uint32_t near = ~bits(pass_by(object, rays)) & all_lanes<float>;
    if (near == 0)
        return;
    test([&](vmask<float> valid, const vreal<float>& t, int piece) {
        visit(valid & from_bits<float>(near), t, piece);
    });
}

/// Calls `visit(valid, t, piece)` for all places where rays cross the object; `from` is the
/// object itself or what an origin shared by all rays made of it.
template <class From, class Visit>
inline void visit_stiff(const abi::StiffObject& object, const From& from,
                        const RayPacket<float>& rays, const Visit& visit)
{
    switch (object.kind) {
        case abi::StiffKind::sphere:
            return visit_near(object, rays, visit, [&](const auto& near_only) {
                visit_stiff_roots(from.sphere, rays, near_only);
            });
        case abi::StiffKind::huge_sphere:
            return visit_stiff_roots(from.huge, rays, visit);
        case abi::StiffKind::plane:
            return visit_stiff_plane(from.plane, rays, visit);
        case abi::StiffKind::quadric:
            return visit_near(object, rays, visit, [&](const auto& near_only) {
                visit_stiff_quadric(from.quadric, rays, near_only);
            });
    }
}

template <class Visit>
inline void visit_stiff(const abi::StiffObject& object, const RayPacket<float>& rays,
                        const Visit& visit)
{
    visit_stiff(object, object, rays, visit);
}

template <class Visit>
inline void visit_stiff(const SharedOriginStiff& shared, const RayPacket<float>& rays,
                        const Visit& visit)
{
    visit_stiff(*shared.object, shared, rays, visit);
}

inline std::int32_t surface_of(const abi::StiffObject& object)
{
    return object.surface;
}
inline std::int32_t surface_of(const SharedOriginStiff& shared)
{
    return shared.object->surface;
}

inline SharedOriginStiff share_origin(const abi::StiffObject& object, const Vec3v<double>& origin)
{
    SharedOriginStiff shared;
    shared.object = &object;
    switch (object.kind) {
        case abi::StiffKind::sphere:
            shared.sphere = share_origin(object.sphere, origin);
            break;
        case abi::StiffKind::huge_sphere:
            shared.huge = share_origin<double>(object.huge, origin);
            break;
        case abi::StiffKind::plane:
            shared.plane = share_origin<double>(object.plane, origin);
            break;
        case abi::StiffKind::quadric:
            shared.quadric = share_origin<double>(object.quadric, origin);
            break;
    }
    return shared;
}

/// Whether rays of `beam`, all from its base, surely miss the object.
inline bool passes_by(const Beam<float>& beam, const SharedOriginStiff& shared)
{
    if (shared.object->kind == abi::StiffKind::huge_sphere) {
        const auto& g = shared.huge.g;
        const float inwards[3] = {-static_cast<float>(g[0]), -static_cast<float>(g[1]),
                                  -static_cast<float>(g[2])};
        return shared.huge.constant > 0 && runs_against(beam, inwards);
    }
    if (shared.object->kind == abi::StiffKind::plane) {
        const double side = shared.plane.height < 0 ? -1.0 : 1.0;
        const auto& n = shared.plane.normal;
        const float towards[3] = {static_cast<float>(side * n[0]), static_cast<float>(side * n[1]),
                                  static_cast<float>(side * n[2])};
        return shared.plane.height != 0 && runs_against(beam, towards);
    }
    const Vec3v<float> to_bound = broadcast(shared.object->bound) - broadcast(beam.base);
    return beam.bounded &&
           none(may_meet<float>(beam, to_bound, vreal<float>(shared.object->bound_radius)));
}

/// What rays of a beam may meet of the stiff objects. There are none in double precision, which
/// needs nothing wider.
template <class Real>
struct StiffCandidates {
    SharedOriginStiff* list = nullptr;
    int count = 0;
};
template <>
struct StiffCandidates<double> {
    static constexpr int count = 0;
};

inline void find_stiff(StiffCandidates<float>& candidates, const Beam<float>& beam,
                       const abi::SceneView<float>& scene)
{
    const Vec3v<float> base = broadcast(beam.base);
    candidates.count = 0;
    for (int i = 0; i < scene.stiff.count; ++i) {
        candidates.list[candidates.count] = share_origin(scene.stiff.data[i], low_half(base));
        candidates.count += !passes_by(beam, candidates.list[candidates.count]);
    }
}
inline void find_stiff(StiffCandidates<double>&, const Beam<double>&, const abi::SceneView<double>&)
{
}

inline bool any_stiff(const abi::SceneView<float>& scene)
{
    return scene.stiff.count != 0;
}
inline bool any_stiff(const StiffCandidates<float>& candidates)
{
    return candidates.count != 0;
}
template <class List>
constexpr bool any_stiff(const List&)
{
    return false;
}

/// Calls `each(object)` for every stiff object of a scene, or of a beam, while it returns true.
template <class Each>
inline void for_each_stiff(const abi::SceneView<float>& scene, const Each& each)
{
    for (int i = 0; i < scene.stiff.count; ++i)
        if (!each(scene.stiff.data[i]))
            return;
}
template <class Each>
inline void for_each_stiff(const StiffCandidates<float>& candidates, const Each& each)
{
    for (int i = 0; i < candidates.count; ++i)
        if (!each(candidates.list[i]))
            return;
}
template <class Each>
inline void for_each_stiff(const abi::SceneView<double>&, const Each&)
{
}
template <class Each>
inline void for_each_stiff(const StiffCandidates<double>&, const Each&)
{
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
