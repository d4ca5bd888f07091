#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/records.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// abi::MaterialRecord, one per lane.
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
        material,
        active, [&](lane_int<Real> number) -> const auto& { return scene.materials[number]; });
    return {record.vector(0),  record.vector(3),  record.vector(6), record.vector(9),
            record.vector(12), record.vector(15), record.field[18], record.field[19]};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
