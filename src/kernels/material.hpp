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
    static_assert(sizeof(abi::MaterialRecord<Real>) == 20 * sizeof(Real));
    const auto record = fetch_records<20, Real>(&scene.materials->ambient[0], material, active);
    return {record.vector(0),  record.vector(3),  record.vector(6), record.vector(9),
            record.vector(12), record.vector(15), record.field[18], record.field[19]};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
