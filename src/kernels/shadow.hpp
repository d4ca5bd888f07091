#pragma once

#include "kernels/lighting.hpp"
#include "kernels/occluded.hpp"
#include "kernels/shade_context.hpp"

// Shadow rays of a packet. Those of a point light are traced from it, where they share their
// origin: t there is 1 - t of the notes' ray from the point.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// How far the segment from the light goes: up to epsilon before the point, which counts in
/// lengths of the segment or, for unit directions, of space.
template <class Real>
inline SegmentEnd<Real> segment_end(const abi::SceneView<Real>& scene,
                                    const LightPacket<Real>& packet)
{
    const vreal<Real> one(Real(1));
    const vreal<Real> epsilon(scene.epsilon);
    return {scene.units == abi::RayUnits::unit ? nmadd(epsilon, packet.inverse_length, one)
                                               : one - epsilon};
}

/// Calls `trace(end, objects, rays)` for the shadow rays of one light.
template <class Real, class Trace>
inline auto with_shadow_rays(const ShadeContext<Real>& context, int light,
                             const LightPacket<Real>& packet, const Vec3v<Real>& point,
                             const Trace& trace)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::LightRecord<Real>& record = scene.lights.data[light];
    if (record.kind == abi::LightKind::directional)
        return trace(NoEnd<Real>{}, scene, make_rays<Real>(point, packet.to_light, scene.epsilon));
    const Vec3v<Real> away{negated(packet.to_light.x), negated(packet.to_light.y),
                           negated(packet.to_light.z)};
    return trace(segment_end(scene, packet), context.blockers[light],
                 make_rays<Real>(broadcast(record.vector), away, Real(0)));
}

/// Lanes of `wanted` that no opaque or any other object keeps from the light.
template <abi::Features F, class Real>
inline std::uint32_t unshadowed(const ShadeContext<Real>& context, int light,
                                const LightPacket<Real>& packet, const Vec3v<Real>& point,
                                std::uint32_t wanted)
{
    if (!context.scene->shadows || wanted == 0)
        return wanted;
    context.counts->shadow += static_cast<unsigned>(__builtin_popcount(wanted));
    return wanted & ~with_shadow_rays(context, light, packet, point,
                                      [&](const auto& end, const auto& objects, const auto& rays) {
                                          return occluded<F>(end, objects, rays, wanted);
                                      });
}

/// Lanes in which any channel is above 0.
template <class Real>
inline std::uint32_t any_channel(const Vec3v<Real>& v)
{
    const vreal<Real> zero(Real(0));
    return bits((v.x > zero) | (v.y > zero) | (v.z > zero));
}

/// The share of the light that gets through: the product of what each blocking object
/// transmits, once however often the segment crosses it.
template <abi::Features F, class Real>
inline Vec3v<Real> transmitted(const ShadeContext<Real>& context, int light,
                               const LightPacket<Real>& packet, const Vec3v<Real>& point,
                               std::uint32_t wanted)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const vreal<Real> one(Real(1));
    Vec3v<Real> share{one, one, one};
    context.counts->shadow += static_cast<unsigned>(__builtin_popcount(wanted));
    const auto pass_on = [&](std::int32_t surface, std::uint32_t blocked) {
        if ((blocked & wanted) == 0)
            return true;
        const auto& material = scene.materials[scene.material_index[surface].first];
        share = select(from_bits<Real>(blocked), share * broadcast(material.transmit), share);
        return (any_channel(share) & wanted) != 0;
    };
    with_shadow_rays(context, light, packet, point,
                     [&](const auto& end, const auto& objects, const auto& rays) {
                         visit_blockers<F>(end, objects, rays, pass_on);
                         return 0;
                     });
    return share;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
