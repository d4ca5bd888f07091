#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/records.hpp"

// What is known of the hit points before any light is looked at.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct SurfacePacket {
    Vec3v<Real> point;
    Vec3v<Real> normal;          ///< unit
    Vec3v<Real> dir;             ///< of the ray that came here, not unit
    vreal<Real> inverse_length;  ///< 1 / |dir|
    vint<Real> material;
};

/// Normal of a plane or sphere at `point` (abi::SurfaceRecord), made unit.
template <class Real>
inline Vec3v<Real> unit_normal(const RecordPacket<8, Real>& surface, const Vec3v<Real>& point,
                               const Vec3v<Real>& dir)
{
    const Vec3v<Real> gradient =
        madd<Real>(surface.field[6], point - surface.vector(0), surface.vector(3));
    const vreal<Real> one(Real(1));
    const Vec3v<Real> normal = scale<Real>(one / sqrt(dot(gradient, gradient)), gradient);
    const vreal<Real> zero(Real(0));
    const auto turn = (surface.field[7] > zero) & (dot(normal, dir) > zero);
    return scale<Real>(select(turn, negated(one), one), normal);
}

/// 0 or 1 where the squares have their first or their other colour.
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

template <class Real>
inline vint<Real> material_of(const abi::SceneView<Real>& scene, const vint<Real>& object,
                              const Vec3v<Real>& point, std::uint32_t active)
{
    vint<Real> material(lane_int<Real>(0));
    for_each_distinct<Real>(object, active, [&](lane_int<Real> number, vmask<Real> same) {
        const abi::MaterialIndex index = scene.material_index[number];
        vint<Real> chosen(static_cast<lane_int<Real>>(index.first));
        if (index.checker >= 0)
            chosen = chosen + checker_parity(scene.checkers[index.checker], point);
        material = select(same, chosen, material);
    });
    return material;
}

template <class Real>
inline SurfacePacket<Real> surface_at(const abi::SceneView<Real>& scene, const Vec3v<Real>& point,
                                      const Vec3v<Real>& dir, const vint<Real>& object,
                                      std::uint32_t active)
{
    static_assert(sizeof(abi::SurfaceRecord<Real>) == 8 * sizeof(Real));
    const auto surface = fetch_records<8, Real>(&scene.surfaces->anchor[0], object, active);
    SurfacePacket<Real> result;
    result.point = point;
    result.dir = dir;
    result.normal = unit_normal<Real>(surface, point, dir);
    result.inverse_length = vreal<Real>(Real(1)) / sqrt(dot(dir, dir));
    result.material = material_of(scene, object, point, active);
    return result;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
