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
inline vreal<Real> segment_end(const abi::SceneView<Real>& scene,
                                    const LightPacket<Real>& packet)
{
    const vreal<Real> one(Real(1));
    const vreal<Real> epsilon(scene.epsilon);
    return scene.units == abi::RayUnits::unit ? nmadd(epsilon, packet.inverse_length, one)
                                              : one - epsilon;
}

/// Calls `trace(t_end, rays)` for the shadow rays of one light; those along a directional one
/// have no end.
template <abi::Features F, class Real, class Trace>
inline auto with_shadow_ray(const ShadeContext<F, Real>& context, int light,
                            const LightPacket<Real>& packet, const Vec3v<Real>& point,
                            const Trace& trace)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::LightRecord<Real>& record = scene.lights.data[light];
    if (record.kind == abi::LightKind::directional)
        return trace(vreal<Real>(static_cast<Real>(__builtin_inf())),
                     make_rays<Real>(point, packet.to_light, scene.epsilon));
    const Vec3v<Real> away{negated(packet.to_light.x), negated(packet.to_light.y),
                           negated(packet.to_light.z)};
    return trace(segment_end(scene, packet),
                 make_rays<Real>(broadcast(record.vector), away, Real(0)));
}

/// Calls `trace(end, objects, rays)` for the shadow rays of one light.
template <abi::Features F, class Real, class Trace>
inline auto with_shadow_rays(const ShadeContext<F, Real>& context, int light,
                             const LightPacket<Real>& packet, const Vec3v<Real>& point,
                             const Trace& trace)
{
    const abi::SceneView<Real>& scene = *context.scene;
    return with_shadow_ray(
        context, light, packet, point,
        [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
            if (scene.lights.data[light].kind == abi::LightKind::directional)
                return trace(NoEnd<Real>{}, scene, rays);
            return trace(SegmentEnd<Real>{t_end}, context.blockers[light], rays);
        });
}

/// Lanes of `wanted` that no opaque or any other object keeps from the light.
template <abi::Features F, class Real>
inline std::uint32_t unshadowed(const ShadeContext<F, Real>& context, int light,
                                const LightPacket<Real>& packet, const Vec3v<Real>& point,
                                std::uint32_t wanted, int first)
{
    if (!context.scene->shadows || wanted == 0)
        return wanted;
    context.counts->shadow += static_cast<unsigned>(__builtin_popcount(wanted));
    if (context.shadows != nullptr)
        return wanted & context.shadows[light].lit_lanes(first);
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
inline Vec3v<Real> transmitted(const ShadeContext<F, Real>& context, int light,
                               const LightPacket<Real>& packet, const Vec3v<Real>& point,
                               std::uint32_t wanted, int first)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const vreal<Real> one(Real(1));
    Vec3v<Real> share{one, one, one};
    context.counts->shadow += static_cast<unsigned>(__builtin_popcount(wanted));
    if (context.shadows != nullptr)
        return context.shadows[light].shares(first);
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
