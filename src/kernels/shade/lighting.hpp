#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/lists/occluded.hpp"
#include "kernels/shade/hit_points.hpp"
#include "kernels/shade/power.hpp"
#include "kernels/stats/observe.hpp"

// Local light at a packet of hits: the diffuse and specular sums of note 001, with shadows.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The direction towards one light, and its terms without occluders.
template <class Real>
struct LightPacket {
    Vec3v<Real> to_light;        ///< not unit
    vreal<Real> diffuse;         ///< max(0, N·L), unit vectors
    vreal<Real> highlight;       ///< R·V, unit vectors, where positive and above the floor
    vreal<Real> inverse_length;  ///< of to_light
    std::uint32_t has_highlight;
    std::uint32_t wanted;  ///< lanes to which the light can add anything
};

/// R·V of the reflected light direction R = 2 (N·L) N - L equals 2 (N·L)(N·V) - L·V.
template <class Real>
inline LightPacket<Real> light_at(const abi::SceneView<Real>& scene,
                                  const abi::LightRecord<Real>& light,
                                  const SurfacePacket<Real>& surface,
                                  const MaterialPacket<Real>& material, std::uint32_t active)
{
    const bool is_point = light.kind == abi::LightKind::point;
    const vreal<Real> zero(Real(0));
    LightPacket<Real> result;
    result.to_light = is_point ? broadcast(light.vector) - surface.point : broadcast(light.vector);
    const vreal<Real> length2 = dot(result.to_light, result.to_light);
    const vreal<Real> inverse_length = vreal<Real>(Real(1)) / sqrt(length2);

    const vreal<Real> normal_light = dot(surface.normal, result.to_light);
    result.inverse_length = inverse_length;
    result.diffuse = max(normal_light, zero) * inverse_length;
    const vreal<Real> normal_dir = dot(surface.normal, surface.dir);
    const vreal<Real> mirror =
        nmadd(normal_light + normal_light, normal_dir, dot(result.to_light, surface.dir));
    result.highlight = mirror * inverse_length * surface.inverse_length;
    const vmask<Real> in_front = normal_light > vreal<Real>(scene.lighting.highlight_above);
    result.has_highlight = bits(in_front & (result.highlight > zero) &
                                (result.highlight >= material.highlight_floor)) &
                           active;
    result.wanted = (bits(normal_light > zero) & active) | result.has_highlight;
    return result;
}

/// diffuse kd + highlight^n ks, times the light's intensity, in the lanes of `lit`; 0 elsewhere.
template <class Real>
inline Vec3v<Real> lit_color(const abi::LightRecord<Real>& light, const LightPacket<Real>& packet,
                             const MaterialPacket<Real>& material, std::uint32_t lit,
                             abi::RayCounts& counts)
{
    const vreal<Real> zero(Real(0));
    Vec3v<Real> sum = scale<Real>(packet.diffuse, material.diffuse);
    const std::uint32_t shiny = packet.has_highlight & lit;
    if (shiny != 0) {
        const StepScope step(abi::Step::highlight);
        count_packet<Real>(abi::PacketWork::highlight, shiny);
        counts.passed |= abi::passed_powers;
        const vreal<Real> power =
            select(from_bits<Real>(shiny),
                   highlight_power<Real>(packet.highlight, material.shininess), zero);
        sum = madd<Real>(power, material.highlight, sum);
    }
    const Vec3v<Real> color = sum * broadcast(light.intensity);
    return select(from_bits<Real>(lit), color, {zero, zero, zero});
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
