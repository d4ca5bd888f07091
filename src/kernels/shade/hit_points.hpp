#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/precision/leave_surface.hpp"
#include "kernels/simd/records.hpp"

// Surface and material at hit points, which all lights share.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// One abi::MaterialRecord per lane.
template <class Real>
struct MaterialPacket {
    Vec3v<Real> ambient, diffuse, highlight, reflect, local, transmit;
    vreal<Real> shininess, highlight_floor;
};

template <class Real>
inline MaterialPacket<Real> fetch_materials(const abi::SceneView<Real>& scene,
                                            const vint<Real>& material, std::uint32_t active)
{
    const auto record = find_records<20, Real>(
        material, active, [&](lane_int<Real> number) -> const auto& {
            return scene.materials.records[number];
        });
    return {record.vector(0),  record.vector(3),  record.vector(6), record.vector(9),
            record.vector(12), record.vector(15), record.field[18], record.field[19]};
}

template <class Real>
struct SurfacePacket {
    Vec3v<Real> point;
    Vec3v<Real> normal;          ///< unit; flipped to face the ray if the model says so
    Vec3v<Real> dir;             ///< direction of the ray that hit here
    vreal<Real> inverse_length;  ///< 1 / |dir|
    vint<Real> number;
    lane_int<Real> common;  ///< the number that all active lanes have; -1 if they differ
    vint<Real> material;
    vint<Real> object;
    lane_int<Real> common_material;  ///< the material of all active lanes; -1 if they differ
    Vec3v<Real> offset;              ///< origin offset of rays that start on the outer side
    std::uint32_t leaving;           ///< lanes whose ray comes from inside
    std::uint32_t turned;            ///< lanes whose normal is the flipped outward normal
};

/// A ray comes from inside if n·d is above this. With SelfHits::exact, child rays start on the side
/// that the ray comes from. A ray that grazes the surface within the resolution of single precision
/// comes from outside: no ray from inside does so unless it starts there.
template <class Real>
inline vreal<Real> grazing(const abi::SceneView<Real>& scene, const Vec3v<Real>& outward,
                           const Vec3v<Real>& dir)
{
    if (sizeof(Real) != sizeof(float) || !(scene.rules.start_error > 0))
        return vreal<Real>(Real(0));
    return vreal<Real>(Real(4) * scene.rules.start_error) * magnitude_dot(outward, dir);
}

/// Fills `normal`, `offset`, `leaving` and `turned` from the outward unit normal. In the lanes of
/// `faces_viewer` the normal is flipped to face the ray.
template <class Real>
inline void set_normal(SurfacePacket<Real>& surface, const abi::SceneView<Real>& scene,
                       const Vec3v<Real>& outward, std::uint32_t faces_viewer)
{
    const vreal<Real> zero(Real(0));
    surface.leaving = bits(dot(outward, surface.dir) > grazing(scene, outward, surface.dir));
    surface.offset = {zero, zero, zero};
    if (scene.rules.start_error > 0)
        surface.offset = origin_offset<Real>(scene.rules.start_error, surface.point, outward);
    surface.turned = faces_viewer & surface.leaving;
    surface.normal = select(from_bits<Real>(surface.turned),
                            scale<Real>(vreal<Real>(Real(-1)), outward), outward);
}

/// 0 on squares of the first colour, 1 on squares of the other colour.
template <class Real>
inline vint<Real> checker_parity(const abi::CheckerRecord<Real>& checker, const Vec3v<Real>& point)
{
    const Vec3v<Real> p = point - broadcast(checker.point);
    const vreal<Real> squares =
        floor<Real>(dot(broadcast(checker.u), p)) + floor<Real>(dot(broadcast(checker.v), p));
    const vreal<Real> half = squares * vreal<Real>(Real(0.5));
    const auto odd = floor<Real>(half) < half;
    return select(odd, vint<Real>(lane_int<Real>(1)), vint<Real>(lane_int<Real>(0)));
}

/// The material of a surface at each of the points.
template <class Real>
inline vint<Real> material_at(const abi::SceneView<Real>& scene, const abi::MaterialIndex& index,
                              const Vec3v<Real>& point)
{
    const vint<Real> first(static_cast<lane_int<Real>>(index.first));
    return index.checker < 0
               ? first
               : first + checker_parity(scene.materials.checkers[index.checker], point);
}

/// Fills `material` and `object` if the lanes of `active` are on several surfaces.
template <class Real>
inline void set_materials(SurfacePacket<Real>& surface, const abi::SceneView<Real>& scene,
                          std::uint32_t active)
{
    alignas(64) lane_int<Real> number[lanes<Real>];
    alignas(64) lane_int<Real> material[lanes<Real>] = {};
    alignas(64) lane_int<Real> object[lanes<Real>] = {};
    store(number, surface.number);
    std::uint32_t checkered = 0;
    for (std::uint32_t left = active; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const abi::MaterialIndex& index = scene.materials.of_surface[number[lane]];
        material[lane] = index.first;
        object[lane] = index.object;
        checkered |= (index.checker < 0 ? 0u : 1u) << lane;
    }
    surface.material = load(material);
    surface.object = load(object);
    for_each_distinct<Real>(
        surface.number, checkered, [&](lane_int<Real> of, const vmask<Real>& same) {
            surface.material =
                select(same, material_at(scene, scene.materials.of_surface[of], surface.point),
                       surface.material);
        });
}

/// The number that all lanes of `active` have; -1 if they differ.
template <class Real>
inline lane_int<Real> common_number(const vint<Real>& number, std::uint32_t active)
{
    const DistinctNumbers<Real> distinct(number, active);
    return distinct.is_only() ? distinct.value() : -1;
}

/// Fills `material`, `object`, `common` and `common_material`.
template <class Real>
inline void set_material(SurfacePacket<Real>& surface, const abi::SceneView<Real>& scene,
                         std::uint32_t active)
{
    surface.common = common_number<Real>(surface.number, active);
    if (surface.common < 0) {
        set_materials(surface, scene, active);
        surface.common_material = common_number<Real>(surface.material, active);
        return;
    }
    const abi::MaterialIndex& index = scene.materials.of_surface[surface.common];
    surface.material = material_at(scene, index, surface.point);
    surface.object = vint<Real>(static_cast<lane_int<Real>>(index.object));
    surface.common_material = index.checker < 0 ? static_cast<lane_int<Real>>(index.first)
                                                : common_number<Real>(surface.material, active);
}

/// The lanes whose surface has a normal that faces the ray; call it after set_material().
template <class Real>
inline std::uint32_t facing_viewer(const abi::ShapesView& shapes,
                                   const SurfacePacket<Real>& surface, std::uint32_t active)
{
    if (surface.common >= 0)
        return shapes.index[surface.common].faces_viewer != 0 ? all_lanes<Real> : 0;
    alignas(64) lane_int<Real> number[lanes<Real>];
    store(number, surface.number);
    std::uint32_t lanes_of = 0;
    for (std::uint32_t left = active; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        lanes_of |= (shapes.index[number[lane]].faces_viewer != 0 ? 1u : 0u) << lane;
    }
    return lanes_of;
}

/// The surfaces at hits, from their outward unit normals.
template <class Real>
inline SurfacePacket<Real> surface_at(const abi::SceneView<Real>& scene, const Vec3v<Real>& point,
                                      const Vec3v<Real>& normal, const Vec3v<Real>& dir,
                                      const vint<Real>& number, std::uint32_t active)
{
    SurfacePacket<Real> surface;
    surface.point = point;
    surface.dir = dir;
    surface.number = number;
    set_material(surface, scene, active);
    set_normal(surface, scene, normal, facing_viewer(scene.shapes, surface, active));
    surface.inverse_length = vreal<Real>(Real(1)) / sqrt(dot(dir, dir));
    return surface;
}

/// Keeps the materials of the last packet: mostly all lanes of the next packet have the same one.
template <class Real>
class LastMaterials {
public:
    const MaterialPacket<Real>& fetch(const abi::SceneView<Real>& scene,
                                      const SurfacePacket<Real>& surface, std::uint32_t active)
    {
        if (surface.common_material < 0 || surface.common_material != common_)
            materials_ = fetch_materials(scene, surface.material, active);
        common_ = surface.common_material;
        return materials_;
    }

private:
    MaterialPacket<Real> materials_;
    lane_int<Real> common_ = -1;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
