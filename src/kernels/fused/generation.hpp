#pragma once

#include "kernels/fused/clear_way.hpp"
#include "kernels/fused/common_hit.hpp"
#include "kernels/precision/refine.hpp"
#include "kernels/stream/spawn.hpp"
#include "kernels/stream/trace_stream.hpp"

// One generation of a packet of paths: where its rays hit, the light there, and the mirrored rays
// that take their place. The same operations as those of streams, so the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// What rays of a generation are tested against.
template <abi::Features F>
struct NearObjects {
    const FilteredObjects<false>* objects;
    const LightObjects<F, float>* occluders;
};

/// Objects with bounds for the origins of one packet.
template <abi::Features F>
[[gnu::noinline]] NearObjects<F> find_from_far(const FusedTile<F>& tile, const Vec3v<float>& place,
                                               std::uint32_t active)
{
    const Origins origins = origins_of_lanes(place, active);
    FusedMemory<F>& memory = tile.memory;
    find_objects<F>(memory.from_far, origins, tile.scene);
    const auto& lights = tile.scene.lighting.lights;
    for (int i = 0; i < lights.count; ++i) {
        if (!lights.data[i].casts_shadow)
            continue;
        if (lights.data[i].kind == abi::LightKind::point)
            memory.occluders[i].from_point = tile.plan.occluders[i].from_point;
        else
            find_objects<F>(memory.occluders[i].along, origins, casters_of(tile.scene));
    }
    return {&memory.from_far, memory.occluders};
}

template <abi::Features F>
inline NearObjects<F> objects_near(const FusedTile<F>& tile, const Vec3v<float>& place,
                                   std::uint32_t active)
{
    if ((far_lanes(tile.plan, place) & active) != 0)
        return find_from_far(tile, place, active);
    return {&tile.plan.from_near, tile.plan.occluders};
}

/// A packet of hits while it is lit.
template <abi::Features F>
struct LitHits {
    SurfacePacket<float>& surface;
    const Vec3v<float>& outward;
    const vreal<float>& normal_dir;  ///< of the normal that may be turned, N·D
    const vreal<float>& dir2;
    const MaterialPacket<float>& material;
    const vreal<float>& floor_dir2;  ///< squared cosine below which nothing shines, times D·D
    bool is_far;                     ///< some are beyond the plan's origins
    std::uint32_t active;
};

/// The lanes of `wanted` that see a light.
template <abi::Features F>
inline std::uint32_t lit_lanes(const FusedTile<F>& tile, int number, const LitHits<F>& hits,
                               const LightPacket<float>& packet, const vreal<float>& length2,
                               std::uint32_t lit_side)
{
    const abi::LightRecord<float>& light = tile.scene.lighting.lights.data[number];
    const ClearTests& tests = tile.plan.clear[number];
    const std::uint32_t wanted = packet.wanted;
    count_shadow_rays(tile.counts, 0, wanted);
    const bool is_plain = tests.complete && !hits.is_far && (wanted & ~lit_side) == 0 &&
                          (hits.surface.leaving & hits.active) == 0;
    std::uint32_t open = wanted;
    if (is_plain)
        open = light.kind == abi::LightKind::point
                   ? open_towards(tests, hits.surface, packet.to_light, length2,
                                  length2 * packet.inverse_length, wanted)
                   : open_along(tests, hits.surface, packet.to_light, wanted);
    if (open == 0)
        return wanted;
    const LightObjects<F, float>* occluders = tile.plan.occluders;
    if (hits.is_far)
        occluders = find_from_far(tile, hits.surface.point, hits.active).occluders;
    return (wanted & ~open) |
           trace_to_light(tile, number, occluders, hits.surface, hits.outward, packet, open);
}

/// Adds the light of one source at a packet of hits, in the lanes that see it.
template <abi::Features F>
inline void add_light(const FusedTile<F>& tile, int number, const LitHits<F>& hits,
                      Vec3v<float>& color)
{
    const vreal<float> zero(0.0f);
    const abi::SceneView<float>& scene = tile.scene;
    const abi::LightRecord<float>& light = scene.lighting.lights.data[number];
    const SurfacePacket<float>& surface = hits.surface;
    const bool is_point = light.kind == abi::LightKind::point;
    LightPacket<float> packet;
    packet.to_light = broadcast(light.vector);
    vreal<float> length2(tile.plan.clear[number].length2);
    if (is_point) {
        packet.to_light = packet.to_light - surface.point;
        length2 = dot(packet.to_light, packet.to_light);
    }
    const vreal<float> normal_light = dot(surface.normal, packet.to_light);
    const std::uint32_t lit_side = bits(normal_light > zero) & hits.active;
    // What is below the floor by more than rounding shows no highlight, and needs no root.
    const vreal<float> mirror = nmadd(normal_light + normal_light, hits.normal_dir,
                                      dot(packet.to_light, surface.dir));
    const std::uint32_t shining =
        bits(mirror * abs(mirror) >= hits.floor_dir2 * length2) & hits.active;
    if ((lit_side | shining) == 0)
        return;
    packet.inverse_length = is_point ? vreal<float>(1.0f) / sqrt(length2)
                                     : vreal<float>(tile.plan.clear[number].inverse_length);
    packet.diffuse = max(normal_light, zero) * packet.inverse_length;
    packet.has_highlight = 0;
    if (shining != 0) {
        packet.highlight =
            mirror * packet.inverse_length * (vreal<float>(1.0f) / sqrt(hits.dir2));
        packet.has_highlight =
            bits((packet.highlight > zero) &
                 (packet.highlight >= hits.material.highlight_floor) &
                 (normal_light > vreal<float>(scene.lighting.highlight_above))) &
            shining;
    }
    packet.wanted = lit_side | packet.has_highlight;
    std::uint32_t lit = packet.wanted;
    if (lit == 0)
        return;
    if (light.casts_shadow)
        lit = lit_lanes(tile, number, hits, packet, length2, lit_side);
    if (lit != 0)
        color = color + lit_color<F>(light, packet, hits.material, lit, tile.counts);
}

/// Replaces the rays of a packet by those that its hits mirror.
template <abi::Features F>
inline void mirror_rays(const FusedTile<F>& tile, PathState& path,
                        SurfacePacket<float>& surface, const Vec3v<float>& outward,
                        const vreal<float>& normal_dir, const MaterialPacket<float>& material,
                        std::uint32_t active)
{
    const std::uint32_t mirrored_lanes = active & any_channel(material.reflect);
    path.active = mirrored_lanes;
    if (mirrored_lanes == 0)
        return;
    if (surface.common < 0)
        surface.common = common_number<float>(surface.number, mirrored_lanes);
    tile.counts.reflected += static_cast<unsigned>(__builtin_popcount(mirrored_lanes));
    tile.counts.stages |= abi::stage_mirrored;
    const abi::RayRules<float>& rules = tile.scene.rules;
    const Vec3v<float> lift = origin_offset<float>(rules.start_error, surface.point, outward);
    const vreal<float> twice = normal_dir * vreal<float>(-2.0f);
    const Vec3v<float> dir = madd<float>(twice, surface.normal, surface.dir);
    const std::uint32_t outside = ~surface.leaving;
    path.own = static_cast<std::int32_t>(surface.common);
    path.is_plain = tile.plan.has_common_hits && !path.is_far && path.own >= 0 &&
                    (surface.leaving & active) == 0;
    path.start.point = surface.point;
    path.start.surface = surface.number;
    path.start.second = second_hit<float>(tile.scene.shapes, surface.number, surface.point, dir,
                                          vreal<float>(rules.secondary_t_min), outside,
                                          mirrored_lanes);
    const Vec3v<float> org =
        surface.leaving == 0
            ? surface.point + lift
            : select(from_bits<float>(outside & all_lanes<float>), surface.point + lift,
                     surface.point - lift);
    path.rays = make_rays<float>(org, dir, rules.secondary_t_min);
    path.weight = path.weight * material.reflect.x;
}

/// The colour of a packet of hits, without what is mirrored there.
template <abi::Features F>
inline Vec3v<float> light_of(const FusedTile<F>& tile, SurfacePacket<float>& surface,
                             const Vec3v<float>& outward, const vreal<float>& normal_dir,
                             const vreal<float>& dir2, const MaterialPacket<float>& material,
                             std::uint32_t active, bool is_far)
{
    Vec3v<float> color = material.ambient;
    // Rounding can't make a shine of a cosine that is below this.
    const vreal<float> floor_dir2 =
        max(material.highlight_floor * material.highlight_floor *
                vreal<float>(1.0f - 0x1p-18f),
            vreal<float>(std::numeric_limits<float>::min())) * dir2;
    const LitHits<F> hits{surface, outward, normal_dir, dir2, material, floor_dir2, is_far, active};
    for (int i = 0; i < tile.scene.lighting.lights.count; ++i)
        add_light(tile, i, hits, color);
    return color;
}

/// The places of a packet's hits, whatever they are on.
struct AnyHits {
    std::uint32_t lanes;
    vint<float> surface;
    Vec3v<float> point;
    Vec3v<float> normal;
};

/// The closest hits of a packet by the search in lists.
template <Generation G, abi::Features F>
[[gnu::noinline]] AnyHits find_any_hits(const FusedTile<F>& tile, const PathState& path,
                                        std::uint32_t active)
{
    const vreal<float> no_end_yet(__builtin_inff());
    HitPacket<float> hit;
    if constexpr (G == Generation::camera) {
        hit = no_hit<float>(__builtin_inff());
        closest_hit<F>(hit, tile.memory.visible, path.rays, NoOwn{});
    } else {
        hit = start_of_search(path.start, no_end_yet);
        const NearObjects<F> near = objects_near(tile, path.rays.org, active);
        closest_hit<F>(hit, *near.objects, path.rays,
                       ActiveOwn{path.start.surface, path.own, active});
    }
    count_unsure(tile.counts, settle_packet<F>(tile.scene, path.rays, hit, path.start, no_end_yet,
                                               active));
    AnyHits hits;
    hits.lanes = hit_lanes(hit) & active;
    hits.surface = hit.surface;
    if (hits.lanes != 0) {
        const RefinedHits<float> places = refined<F, Refine::place>(
            tile.scene.shapes, path.rays, hit, path.start, hits.lanes);
        hits.point = places.point;
        hits.normal = places.normal;
    }
    return hits;
}

/// The surfaces at a packet's hits, of which `surface.point` and `number` are set.
template <abi::Features F>
inline void set_surface(const FusedTile<F>& tile, SurfacePacket<float>& surface,
                        const Vec3v<float>& outward, vreal<float>& normal_dir, std::uint32_t hits)
{
    // Of what faces the ray nothing is inside, nor turned.
    surface.normal = outward;
    surface.leaving = 0;
    normal_dir = dot(surface.normal, surface.dir);
    if ((bits(normal_dir > vreal<float>(0.0f)) & hits) != 0) {
        set_normal(surface, tile.scene, outward, facing_viewer(tile.scene.shapes, surface, hits));
        normal_dir = dot(surface.normal, surface.dir);
    }
}

/// What the lanes of `missed` bring that hit nothing.
template <Generation G, abi::Features F>
inline void add_escaped(const FusedTile<F>& tile, PathState& path, std::uint32_t missed)
{
    if (missed == 0)
        return;
    const Vec3v<float> beyond = escaped(tile.scene, path.rays);
    if constexpr (G == Generation::camera)
        path.color = beyond;
    else
        path.color = select(from_bits<float>(missed), path.color + scale<float>(path.weight, beyond),
                            path.color);
}

/// Shades the hits of a packet, and puts mirrored rays in the place of those that came there.
template <Generation G, abi::Features F>
inline void shade_hits(const FusedTile<F>& tile, PathState& path, SurfacePacket<float>& surface,
                       const Vec3v<float>& outward, std::uint32_t hits, int depth)
{
    const abi::SceneView<float>& scene = tile.scene;
    surface.dir = path.rays.dir;
    const MaterialPacket<float>& material = tile.memory.materials->fetch(scene, surface, hits);
    vreal<float> normal_dir;
    set_surface(tile, surface, outward, normal_dir, hits);
    path.is_far = (far_lanes(tile.plan, surface.point) & hits) != 0;
    Vec3v<float> color = light_of(tile, surface, outward, normal_dir, path.rays.dir2, material,
                                  hits, path.is_far);
    const bool goes_on = depth < scene.rules.max_depth;
    if (goes_on) {
        color = color * material.local;
    } else {
        const Vec3v<float> share = material.reflect + material.transmit;
        color = madd<float>(share, broadcast(scene.rules.limit_color), color);
    }
    if constexpr (G == Generation::mirrored)
        color = path.color + scale<float>(path.weight, color);
    path.color = hits == all_lanes<float> ? color
                                          : select(from_bits<float>(hits), color, path.color);
    if (goes_on)
        mirror_rays(tile, path, surface, outward, normal_dir, material, hits);
}

/// Traces the rays of a packet, adds what they bring, and puts mirrored ones in their place.
template <Generation G, abi::Features F>
inline void trace_generation(const FusedTile<F>& tile, const Candidates& candidates,
                             PathState& path, int depth)
{
    const abi::SceneView<float>& scene = tile.scene;
    const std::uint32_t active = path.active;
    path.active = 0;
    SurfacePacket<float> surface;
    if (path.is_plain) {
        CommonHit hit;
        if (find_common_hit<G>(hit, tile, candidates, path.rays, path.own, active)) {
            add_escaped<G>(tile, path, active & ~hit.lanes);
            if (hit.lanes == 0)
                return;
            surface.point = hit.point;
            surface.number = vint<float>(lane_int<float>{hit.surface});
            surface.common = hit.surface;
            const abi::MaterialIndex& index = scene.materials.of_surface[hit.surface];
            surface.material = material_at(scene, index, surface.point);
            surface.object = vint<float>(lane_int<float>{index.object});
            surface.common_material = index.checker < 0
                                          ? index.first
                                          : common_number<float>(surface.material, hit.lanes);
            return shade_hits<G>(tile, path, surface, hit.normal, hit.lanes, depth);
        }
    }
    const AnyHits any = find_any_hits<G>(tile, path, active);
    add_escaped<G>(tile, path, active & ~any.lanes);
    if (any.lanes == 0)
        return;
    surface.point = any.point;
    surface.dir = path.rays.dir;
    surface.number = any.surface;
    set_material(surface, scene, any.lanes);
    shade_hits<G>(tile, path, surface, any.normal, any.lanes, depth);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
