#pragma once

#include "kernels/shade/shadow.hpp"
#include "kernels/stream/min_weight.hpp"
#include "kernels/stream/spawn.hpp"

// Shades the hits of a chunk: adds the light of each source to the pixels, and appends child rays
// to the next streams.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F, class Real>
inline Vec3v<Real> light_color(const ShadeContext<F, Real>& context, int number,
                               const SurfacePacket<Real>& surface,
                               const MaterialPacket<Real>& material,
                               const PacketProbe<F.probe, Real>& probe, std::uint32_t active,
                               int first)
{
    const abi::LightRecord<Real>& light = context.scene->lighting.lights.data[number];
    const StepScope step(abi::Step::diffuse);
    const LightPacket<Real> packet = light_at(*context.scene, light, surface, material, active);
    if constexpr (F.glass) {
        if (context.scene->lighting.transparent_shadows && light.casts_shadow &&
            packet.wanted != 0) {
            const Vec3v<Real> share =
                transmitted<F>(context, number, packet, surface, packet.wanted, first);
            const std::uint32_t lit =
                count_lit<Real>(packet.wanted, packet.wanted & any_channel(share));
            const Vec3v<Real> color =
                share * lit_color(light, packet, material, lit, *context.counts);
            probe.light(number, packet.wanted, share, color);
            return color;
        }
    }
    const std::uint32_t lit = unshadowed<F>(context, number, packet, surface, packet.wanted, first);
    const Vec3v<Real> color = lit_color(light, packet, material, lit, *context.counts);
    probe.light(number, packet.wanted, lit, color);
    return color;
}

template <abi::Features F, class Real>
inline Vec3v<Real> local_color(const ShadeContext<F, Real>& context,
                               const SurfacePacket<Real>& surface,
                               const MaterialPacket<Real>& material,
                               const PacketProbe<F.probe, Real>& probe, std::uint32_t active,
                               int first)
{
    Vec3v<Real> color = material.ambient;
    for (int i = 0; i < context.scene->lighting.lights.count; ++i)
        color = color + light_color<F>(context, i, surface, material, probe, active, first);
    return color;
}

/// The next generation's rays, reflected before refracted ones, so that their order does not depend
/// on the packet width.
template <abi::Features F, class Real>
struct Children {
    RayStream<F, Real>* reflected;
    RayStream<F, Real>* refracted;  ///< null if nothing refracts
};

template <abi::Features F, class Real>
inline void spawn_children(const ShadeContext<F, Real>& context, const Children<F, Real>& children,
                           const SurfacePacket<Real>& surface, const MaterialPacket<Real>& material,
                           const PathPacket<Real>& path, const GlassPacket<Real>& inside,
                           std::uint32_t active)
{
    const StepScope step(abi::Step::children);
    Vec3v<Real> reflect = material.reflect;
    if constexpr (F.glass) {
        const std::uint32_t glass = active & any_channel(material.transmit);
        if (glass != 0) {
            const RefractedPacket<Real> refracted = refract(*context.scene, surface, inside, glass);
            // Total internal reflection: the transmitted share is reflected too.
            reflect =
                select(from_bits<Real>(refracted.total), reflect + material.transmit, reflect);
            spawn_refracted(
                *children.refracted, *context.scene, surface, path, material.transmit, refracted,
                heavy_enough(context, path, material.transmit, glass & ~refracted.total));
        }
    }
    spawn_reflected(*children.reflected, *context.scene, surface, path, reflect, inside,
                    heavy_enough(context, path, reflect, active & any_channel(reflect)));
}

template <abi::Features F, class Real>
inline void shade_packet(PixelWrite write, const ShadeContext<F, Real>& context,
                         const HitStream<F, Real>& hits, int first, LastMaterials<Real>& materials,
                         Real* pixels, const Children<F, Real>& children)
{
    const std::uint32_t active = first_lanes<Real>(hits.count - first);
    count_packet<Real>(abi::PacketWork::shade, active);
    const PathPacket<Real> path{load_weight(hits, first), load(hits.pixel + first),
                                load_path(hits, first)};
    const PacketProbe<F.probe, Real> probe = packet_probe(hits, path, active);
    const SurfacePacket<Real> surface = context.surfaces != nullptr
                                            ? context.surfaces[first / lanes<Real>]
                                            : surface_of<F>(*context.scene, hits, first, active);
    const MaterialPacket<Real>& material = materials.fetch(*context.scene, surface, active);

    Vec3v<Real> color = local_color<F>(context, surface, material, probe, active, first);
    if (context.spawns()) {
        color = color * material.local;
        probe.hit(surface, color);
        spawn_children(context, children, surface, material, path, load_glass(hits, first), active);
    } else {
        const Vec3v<Real> share = material.reflect + material.transmit;
        const Vec3v<Real> limit = broadcast(context.scene->rules.limit_color);
        probe.last_hit(surface, color, share, limit);
        color = madd<Real>(share, limit, color);
    }
    color = path.weight * color;
    const StepScope step(abi::Step::film);
    write_colors(write, pixels, path.pixel, color, active);
}

/// Shades the hits of a scene in which no light reaches any object: their colour is that of the
/// material.
template <abi::Features F, class Real>
inline void shade_flat(const abi::SceneView<Real>& scene, const HitStream<F, Real>& hits,
                       Real* pixels)
{
    LastMaterials<Real> materials;
    for (int first = 0; first < hits.count; first += lanes<Real>) {
        const std::uint32_t active = first_lanes<Real>(hits.count - first);
        SurfacePacket<Real> surface;
        surface.point = load3(hits.point, first);
        surface.number = load(hits.surface + first);
        set_material(surface, scene, active);
        const MaterialPacket<Real>& material = materials.fetch(scene, surface, active);
        write_colors(PixelWrite::set, pixels, load(hits.pixel + first), material.ambient, active);
    }
}

/// Shades every hit of a stream.
template <abi::Features F, class Real>
inline void shade_stream(PixelWrite write, const ShadeContext<F, Real>& context,
                         const HitStream<F, Real>& hits, Real* pixels,
                         const Children<F, Real>& children)
{
    LastMaterials<Real> materials;
    for (int first = 0; first < hits.count; first += lanes<Real>)
        shade_packet(write, context, hits, first, materials, pixels, children);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
