#pragma once

#include "kernels/fused/clear_way.hpp"
#include "kernels/fused/find_hits.hpp"
#include "kernels/stream/spawn.hpp"

// Traces one generation of a packet of paths: its hits, their light, and the reflected rays that
// replace its rays. The operations, and so the bits, are those of streams.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The possible occluders of a light, by light, for hits outside the plan's origins. For a light
/// that sends rays they are those of the plan.
template <abi::Features F>
[[gnu::noinline]] const LightObjects<F, float>* occluders_from_far(const FusedTile<F>& tile,
                                                                   int light,
                                                                   const Vec3v<float>& place,
                                                                   std::uint32_t active)
{
    if (tile.scene.lighting.lights.data[light].sends_rays)
        return tile.plan.occluders;
    LightObjects<F, float>* const occluders = tile.memory.occluders;
    find_objects<F>(occluders[light].along, origins_of_lanes(place, active),
                    casters_of(tile.scene));
    return occluders;
}

/// A packet of hits while it is shaded.
struct LitHits {
    const HitState& at;
    Vec3v<float> normal;      ///< flipped to face the ray where the surface's normal does
    vreal<float> normal_dir;  ///< N·D
    vreal<float> floor_dir2;  ///< squared cosine below which there is no highlight, times D·D
    std::uint32_t leaving;    ///< lanes whose ray comes from inside
    std::uint32_t turned;     ///< lanes whose normal is flipped
    std::uint32_t again;      ///< lanes that may hit their own object again
    bool is_far;              ///< some are outside the plan's origins
    bool are_plain;           ///< neither `again` nor `is_far`
};

inline SurfacePacket<float> lit_surface(const LitHits& hits, const Vec3v<float>& dir,
                                        float start_error)
{
    SurfacePacket<float> surface;
    surface.point = hits.at.point;
    surface.normal = hits.normal;
    surface.dir = dir;
    surface.number = numbers_of(hits.at);
    surface.common = hits.at.common;
    surface.leaving = hits.leaving;
    surface.turned = hits.turned;
    surface.offset = origin_offset<float>(start_error, surface.point, hits.at.outward);
    return surface;
}

/// The materials of a packet's hits on several surfaces, or on a checker.
template <abi::Features F>
[[gnu::noinline]] void fetch_mixed(PlanMaterial& material, const FusedTile<F>& tile,
                                   const HitState& hit)
{
    SurfacePacket<float> surface;
    surface.point = hit.point;
    surface.number = numbers_of(hit);
    set_material(surface, tile.scene, hit.lanes);
    material.packet = fetch_materials(tile.scene, surface.material, hit.lanes);
    material.floor2 = shine_floor2(material.packet);
    material.reflects = (any_channel(material.packet.reflect) & hit.lanes) != 0;
}

/// Flips normals to face the rays where necessary, and finds the lanes that come from inside.
template <abi::Features F>
[[gnu::noinline]] void turn_normals(LitHits& hits, const FusedTile<F>& tile,
                                    const Vec3v<float>& dir)
{
    SurfacePacket<float> surface;
    surface.point = hits.at.point;
    surface.dir = dir;
    surface.number = numbers_of(hits.at);
    surface.common = hits.at.common;
    set_normal(surface, tile.scene, hits.at.outward,
               facing_viewer(tile.scene.shapes, surface, hits.at.lanes));
    hits.normal = surface.normal;
    hits.leaving = surface.leaving & hits.at.lanes;
    hits.turned = surface.turned & hits.at.lanes;
    hits.normal_dir = dot(hits.normal, dir);
}

/// The lanes of `packet.wanted` that a light reaches.
template <abi::Features F>
inline std::uint32_t lit_lanes(const FusedTile<F>& tile, const PlanLight& light,
                               const LitHits& hits, const Vec3v<float>& dir,
                               const LightPacket<float>& packet, const vreal<float>& length2,
                               std::uint32_t lit_side)
{
    const std::uint32_t wanted = packet.wanted;
    tile.counts.shadow += static_cast<unsigned>(__builtin_popcount(wanted));
    tile.counts.passed |= abi::passed_occluders | abi::passed_shadow_rays;
    QuickShadow shadow{0, wanted};
    if (light.clear.complete && hits.are_plain && (wanted & ~lit_side) == 0)
        shadow = light.record.kind == abi::LightKind::point
                     ? shadow_towards(light.clear, hits.at, packet.to_light, length2,
                                      length2 * packet.inverse_length, wanted)
                     : shadow_along(light.clear, hits.at, packet.to_light, wanted);
    const std::uint32_t clear = wanted & ~shadow.open & ~shadow.blocked;
    if (shadow.open == 0)
        return clear;
    const LightObjects<F, float>* occluders = tile.plan.occluders;
    if constexpr (F.exact)
        if (hits.is_far)
            occluders =
                occluders_from_far(tile, light.number, Vec3v<float>(hits.at.point), hits.at.lanes);
    const SurfacePacket<float> surface = lit_surface(hits, dir, tile.scene.rules.start_error);
    const LightPacket<float> copy = packet;
    return clear | trace_to_light(tile, light.number, occluders, surface, copy, shadow.open);
}

/// Adds the light of one source at a packet of hits, in the lanes that it reaches.
template <abi::Features F>
inline void add_light(const FusedTile<F>& tile, const PlanLight& light, const LitHits& hits,
                      const PathState<F>& path, const PlanMaterial& material, Vec3v<float>& color)
{
    const vreal<float> zero(0.0f);
    const std::uint32_t active = hits.at.lanes;
    const bool is_point = light.record.kind == abi::LightKind::point;
    LightPacket<float> packet;
    packet.to_light = broadcast(light.record.vector);
    vreal<float> length2(light.clear.length2);
    if (is_point) {
        packet.to_light = packet.to_light - hits.at.point;
        length2 = dot(packet.to_light, packet.to_light);
    }
    const vreal<float> normal_light = dot(hits.normal, packet.to_light);
    const std::uint32_t lit_side = bits(normal_light > zero) & active;
    // Below the floor, by more than rounding errors, there is no highlight and no root is needed.
    const vreal<float> mirror =
        nmadd(normal_light + normal_light, hits.normal_dir, dot(packet.to_light, path.dir));
    const std::uint32_t shining = bits(mirror * abs(mirror) >= hits.floor_dir2 * length2) & active;
    if ((lit_side | shining) == 0)
        return;
    packet.inverse_length =
        is_point ? vreal<float>(1.0f) / sqrt(length2) : vreal<float>(light.clear.inverse_length);
    packet.diffuse = max(normal_light, zero) * packet.inverse_length;
    packet.has_highlight = 0;
    packet.highlight = zero;
    if (shining != 0) {
        packet.highlight = mirror * packet.inverse_length * (vreal<float>(1.0f) / sqrt(path.dir2));
        packet.has_highlight =
            bits((packet.highlight > zero) & (packet.highlight >= material.packet.highlight_floor) &
                 (normal_light > vreal<float>(tile.scene.lighting.highlight_above))) &
            shining;
    }
    packet.wanted = lit_side | packet.has_highlight;
    std::uint32_t lit = packet.wanted;
    if (lit == 0)
        return;
    if (light.record.casts_shadow)
        lit = lit_lanes(tile, light, hits, path.dir, packet, length2, lit_side);
    if (lit != 0)
        color = color + lit_color(light.record, packet, material.packet, lit, tile.counts);
}

/// Adds the light at a packet of hits to the paths' colours.
template <Generation G, abi::Features F>
inline void add_hits(PathState<F>& path, const Vec3v<float>& light, std::uint32_t hits)
{
    Vec3v<float> color = light;
    if constexpr (G == Generation::reflected)
        color = path.color + path.weight.of(color);
    path.color =
        hits == all_lanes<float> ? color : select(from_bits<float>(hits), color, path.color);
}

/// Adds the light of lanes that hit nothing.
template <Generation G, abi::Features F>
inline void add_escaped(const FusedTile<F>& tile, PathState<F>& path, std::uint32_t missed)
{
    if (missed == 0)
        return;
    const Vec3v<float> beyond = escaped(tile.scene, rays_of<G>(tile, path));
    if constexpr (G == Generation::camera)
        path.color = beyond;
    else
        path.color =
            select(from_bits<float>(missed), path.color + path.weight.of(beyond), path.color);
}

/// Where rays that leave a surface hit the same object again.
template <abi::Features F>
[[gnu::noinline]] SecondHit<float> find_second(const FusedTile<F>& tile, const LitHits& hits,
                                               const Vec3v<float>& dir, std::uint32_t active)
{
    return second_hit<float>(tile.scene.shapes, numbers_of(hits.at), hits.at.point, dir,
                             vreal<float>(tile.scene.rules.secondary_t_min), ~hits.leaving, active);
}

/// Replaces the rays of a packet by the reflected rays of its hits.
template <abi::Features F>
inline void reflect_rays(const FusedTile<F>& tile, PathState<F>& path, PathStart& start,
                         const LitHits& hits, const PlanMaterial& material)
{
    const HitState& at = hits.at;
    path.active = material.reflects ? at.lanes & any_channel(material.packet.reflect) : 0;
    if (path.active == 0)
        return;
    tile.counts.reflected += static_cast<unsigned>(__builtin_popcount(path.active));
    tile.counts.passed |= abi::passed_mirrored;
    const Vec3v<float> offset =
        origin_offset<float>(tile.scene.rules.start_error, at.point, at.outward);
    path.dir = madd<float>(hits.normal_dir * vreal<float>(-2.0f), hits.normal, path.dir);
    path.dir2 = dot(path.dir, path.dir);
    path.weight.reflect(material.packet.reflect);
    path.is_far = hits.is_far;
    path.org = at.point + offset;
    start.common = at.common;
    if (at.common < 0)
        start.common = static_cast<std::int32_t>(common_number<float>(at.number, path.active));
    path.is_plain = tile.plan.common.are_all && hits.are_plain && start.common >= 0;
    start.meets_own = (hits.again & path.active) != 0;
    if (!start.meets_own)
        return;
    path.org =
        select(from_bits<float>(~hits.leaving & all_lanes<float>), path.org, at.point - offset);
    const Vec3v<float> dir = path.dir;
    start.second = find_second(tile, hits, dir, path.active);
}

/// Corrects a packet's hits where rays along `dir` come from inside.
template <abi::Features F>
inline void turn_hits(LitHits& hits, const FusedTile<F>& tile, const Vec3v<float>& dir)
{
    // The address is taken of copies only, so that all other values stay in registers.
    const HitState at = hits.at;
    const Vec3v<float> way = dir;
    LitHits turned{.at = at,
                   .normal = hits.normal,
                   .normal_dir = hits.normal_dir,
                   .floor_dir2 = hits.floor_dir2,
                   .leaving = 0,
                   .turned = 0,
                   .again = 0,
                   .is_far = false,
                   .are_plain = false};
    turn_normals(turned, tile, way);
    hits.normal = turned.normal;
    hits.normal_dir = turned.normal_dir;
    hits.leaving = turned.leaving;
    hits.turned = turned.turned;
    hits.again |= turned.leaving;
}

/// Adds the lights at a packet's hits, and replaces its rays by reflected ones.
template <Generation G, abi::Features F>
inline void shade_hits(const FusedTile<F>& tile, PathState<F>& path, PathStart& start,
                       const LitHits& hits, const PlanMaterial& material, int depth)
{
    const abi::SceneView<float>& scene = tile.scene;
    Vec3v<float> color = material.packet.ambient;
    for (const PlanLight& light : tile.plan.lights)
        add_light(tile, light, hits, path, material, color);
    if (depth < scene.rules.max_depth) {
        add_hits<G>(path, color * material.packet.local, hits.at.lanes);
        reflect_rays(tile, path, start, hits, material);
    } else {
        const Vec3v<float> share = material.packet.reflect + material.packet.transmit;
        add_hits<G>(path, madd<float>(share, broadcast(scene.rules.limit_color), color),
                    hits.at.lanes);
    }
}

/// Traces one generation of a packet, adds its light, and replaces its rays by reflected ones.
template <Generation G, abi::Features F>
inline void trace_generation(const FusedTile<F>& tile, const CommonLists& candidates,
                             PathState<F>& path, PathStart& start, int depth)
{
    find_hits<G>(tile, candidates, path, start);
    const HitState& hit = start.at;
    add_escaped<G>(tile, path, path.active & ~hit.lanes);
    path.active = 0;
    if (hit.lanes == 0)
        return;
    tile.counts.passed |= abi::passed_hits | abi::passed_normals;
    if constexpr (F.exact)
        tile.counts.passed |= abi::passed_refined;

    const PlanMaterial* material = tile.plan.surfaces[hit.common].material;
    PlanMaterial mixed;
    if (material == nullptr) {
        const HitState copy = hit;
        fetch_mixed(mixed, tile, copy);
        material = &mixed;
    }
    // As long as all outward normals face the rays, no ray comes from inside and no normal is
    // flipped.
    LitHits hits{.at = hit,
                 .normal = hit.outward,
                 .normal_dir = dot(hit.outward, path.dir),
                 .floor_dir2 = material->floor2 * path.dir2,
                 .leaving = 0,
                 .turned = 0,
                 .again = F.quadrics && tile.plan.surfaces[hit.common].met_again ? hit.lanes : 0,
                 .is_far = (far_lanes(tile.plan.common, hit.point) & hit.lanes) != 0,
                 .are_plain = false};
    if ((bits(hits.normal_dir > vreal<float>(0.0f)) & hit.lanes) != 0)
        turn_hits(hits, tile, path.dir);
    hits.are_plain = hits.again == 0 && !hits.is_far;
    shade_hits<G>(tile, path, start, hits, *material, depth);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
