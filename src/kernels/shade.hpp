#pragma once

#include "kernels/bounds.hpp"
#include "kernels/lighting.hpp"
#include "kernels/pixels.hpp"

// Shading of a tile's hit points: light by light into the pixels, mirrored rays into the next
// stream.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// What shading a tile needs besides the hits themselves.
template <class Real>
struct ShadeContext {
    const abi::SceneView<Real>* scene;
    /// For each point light, what may stand between it and the hits.
    const SharedOriginObjects<Real>* blockers;
    bool spawn;  ///< below the depth limit: mirrored rays are traced
    abi::RayCounts* counts;
};

/// Lanes of `wanted` in the shadow of `light`. Rays to a point light are traced from it, where
/// they share their origin: t there is 1 - t of note 001's ray from the point.
template <class Real>
inline std::uint32_t shadowed(const ShadeContext<Real>& context, int light,
                              const LightPacket<Real>& packet, const Vec3v<Real>& point,
                              std::uint32_t wanted)
{
    const abi::SceneView<Real>& scene = *context.scene;
    if (!scene.shadows || wanted == 0)
        return 0;
    context.counts->shadow += static_cast<unsigned>(__builtin_popcount(wanted));
    const abi::LightRecord<Real>& record = scene.lights.data[light];
    if (record.kind == abi::LightKind::directional) {
        const RayPacket<Real> rays = make_rays<Real>(point, packet.to_light, scene.epsilon);
        return occluded(NoEnd<Real>{}, scene, rays, wanted);
    }
    const vreal<Real> zero(Real(0));
    const Vec3v<Real> away{zero - packet.to_light.x, zero - packet.to_light.y,
                           zero - packet.to_light.z};
    const RayPacket<Real> rays = make_rays<Real>(broadcast(record.vector), away, Real(0));
    const SegmentEnd<Real> end{vreal<Real>(Real(1) - scene.epsilon)};
    return occluded(end, context.blockers[light], rays, wanted);
}

template <class Real>
inline Vec3v<Real> local_color(const ShadeContext<Real>& context,
                               const SurfacePacket<Real>& surface,
                               const MaterialPacket<Real>& material, std::uint32_t active)
{
    Vec3v<Real> color = material.ambient;
    for (int i = 0; i < context.scene->lights.count; ++i) {
        const abi::LightRecord<Real>& light = context.scene->lights.data[i];
        const LightPacket<Real> packet = light_at(light, surface, material, active);
        const std::uint32_t lit =
            packet.wanted & ~shadowed(context, i, packet, surface.point, packet.wanted);
        if (lit != 0)
            color = color + lit_color(light, packet, material, lit);
    }
    return color;
}

/// Appends the mirrored rays of the lanes that reflect anything.
template <class Real>
inline void spawn_reflected(RayStream<Real>& next, const SurfacePacket<Real>& surface,
                            const Vec3v<Real>& weight, const vint<Real>& pixel,
                            std::uint32_t active)
{
    if (active == 0)
        return;
    const vreal<Real> twice = dot(surface.normal, surface.dir) * vreal<Real>(Real(-2));
    const Vec3v<Real> mirrored = madd<Real>(twice, surface.normal, surface.dir);
    append3(next.org, next.count, active, surface.point);
    append3(next.dir, next.count, active, mirrored);
    append3(next.weight, next.count, active, weight);
    compress_store(next.pixel + next.count, active, pixel);
    next.count += __builtin_popcount(active);
}

/// Lanes in which any channel differs from 0.
template <class Real>
inline std::uint32_t any_channel(const Vec3v<Real>& v)
{
    const vreal<Real> zero(Real(0));
    return bits((v.x > zero) | (v.y > zero) | (v.z > zero));
}

template <PixelWrite Write, class Real>
inline void shade_packet(const ShadeContext<Real>& context, const HitStream<Real>& hits, int first,
                         TilePixelColors<Real>& pixels, RayStream<Real>& next)
{
    const std::uint32_t active = first_lanes<Real>(hits.count - first);
    const vint<Real> pixel = load(hits.pixel + first);
    const Vec3v<Real> weight = load3(hits.weight, first);
    const SurfacePacket<Real> surface =
        surface_at(*context.scene, load3(hits.point, first), load3(hits.dir, first),
                   load(hits.object + first), active);
    const MaterialPacket<Real> material = fetch_materials(*context.scene, surface.material, active);

    Vec3v<Real> color = weight * local_color(context, surface, material, active);
    if (context.spawn) {
        color = color * material.local;
        spawn_reflected(next, surface, weight * material.reflect, pixel,
                        active & any_channel(material.reflect));
    }
    write_colors<Write>(pixels, pixel, color, active);
}

/// Shades every hit of a stream; `next` is emptied first.
template <PixelWrite Write, class Real>
inline void shade_stream(const ShadeContext<Real>& context, const HitStream<Real>& hits,
                         TilePixelColors<Real>& pixels, RayStream<Real>& next)
{
    next.count = 0;
    for (int first = 0; first < hits.count; first += lanes<Real>)
        shade_packet<Write>(context, hits, first, pixels, next);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
