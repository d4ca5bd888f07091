#pragma once

#include "kernels/fused/clear_way.hpp"
#include "kernels/fused/common_hit.hpp"
#include "kernels/precision/refine.hpp"
#include "kernels/stream/spawn.hpp"
#include "kernels/stream/trace_stream.hpp"

// One generation of some packets of paths: where their rays hit, the light there, and the mirrored
// rays that take their place. The same operations as those of streams, so the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// What rays of a packet are tested against.
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

/// The closest hits of a packet by the search in lists, where choose_hit() can't tell.
template <Generation G, abi::Features F>
[[gnu::noinline]] void find_any_hits(const FusedTile<F>& tile, PacketWork& work)
{
    const vreal<float> no_end_yet(__builtin_inff());
    const PathState& path = work.path;
    const RayPacket<float> rays = rays_of<G>(tile, path);
    const StartPacket<float> start =
        G == Generation::camera ? no_start<float>() : start_of(work);
    HitPacket<float> found = start_of_search(start, no_end_yet);
    if constexpr (G == Generation::camera) {
        closest_hit<F>(found, tile.memory.visible, rays, NoOwn{});
    } else {
        const FilteredObjects<false>* const objects =
            path.is_far ? find_from_far(tile, path.org, path.active).objects
                        : &tile.plan.from_near;
        closest_hit<F>(found, *objects, rays, ActiveOwn{start.surface, path.own, path.active});
    }
    count_unsure(tile.counts,
                 settle_packet<F>(tile.scene, rays, found, start, no_end_yet, path.active));
    HitState& hit = work.hit;
    hit.lanes = hit_lanes(found) & path.active;
    if (hit.lanes == 0)
        return;
    const RefinedHits<float> places =
        refined<F, Refine::place>(tile.scene.shapes, rays, found, start, hit.lanes);
    hit.point = places.point;
    hit.outward = places.normal;
    hit.number = found.surface;
    hit.common = static_cast<std::int32_t>(common_number<float>(found.surface, hit.lanes));
}

/// Finds where the rays of a packet hit.
template <Generation G, abi::Features F>
inline void find_hits(const FusedTile<F>& tile, const Choice& choice, PacketWork& work)
{
    CommonHit places;
    if (!choice.is_known) {
        find_any_hits<G>(tile, work);
        return;
    }
    HitState& hit = work.hit;
    if (choice.lanes != 0) {
        if (!refine_choice<G>(places, tile, choice, rays_of<G>(tile, work.path))) {
            find_any_hits<G>(tile, work);
            return;
        }
        hit.point = places.point;
        hit.outward = places.normal;
        hit.common = surface_of(tile.plan, choice);
        hit.number = vint<float>(lane_int<float>{hit.common});
    }
    hit.lanes = choice.lanes;
}

/// What the lanes bring that hit nothing.
template <Generation G, abi::Features F>
inline void add_escaped(const FusedTile<F>& tile, PathState& path, std::uint32_t missed)
{
    if (missed == 0)
        return;
    const Vec3v<float> beyond = escaped(tile.scene, rays_of<G>(tile, path));
    if constexpr (G == Generation::camera)
        path.color = beyond;
    else
        path.color = select(from_bits<float>(missed), path.color + scale<float>(path.weight, beyond),
                            path.color);
}

/// The materials of a packet's hits.
template <abi::Features F>
inline const MaterialPacket<float>* material_of(const FusedTile<F>& tile, PacketWork& work)
{
    const abi::SceneView<float>& scene = tile.scene;
    const HitState& hit = work.hit;
    if (hit.common >= 0) {
        const abi::MaterialIndex& index = scene.materials.of_surface[hit.common];
        if (index.checker < 0)
            return &tile.memory.materials->fetch(scene, index.first);
    }
    SurfacePacket<float> surface;
    surface.point = hit.point;
    surface.number = hit.number;
    set_material(surface, scene, hit.lanes);
    if (surface.common_material >= 0)
        return &tile.memory.materials->fetch(
            scene, static_cast<std::int32_t>(surface.common_material));
    work.mixed = fetch_materials(scene, surface.material, hit.lanes);
    return &work.mixed;
}

/// Sets what lighting needs of a packet's hits.
template <abi::Features F>
inline void prepare_hits(const FusedTile<F>& tile, PacketWork& work)
{
    HitState& hit = work.hit;
    const PathState& path = work.path;
    hit.material = material_of(tile, work);
    hit.color = hit.material->ambient;
    // Of what faces the ray nothing is inside, nor turned.
    hit.normal = hit.outward;
    hit.leaving = 0;
    hit.normal_dir = dot(hit.normal, path.dir);
    if ((bits(hit.normal_dir > vreal<float>(0.0f)) & hit.lanes) != 0) {
        SurfacePacket<float> surface;
        surface.point = hit.point;
        surface.dir = path.dir;
        surface.number = hit.number;
        surface.common = hit.common;
        set_normal(surface, tile.scene, hit.outward,
                   facing_viewer(tile.scene.shapes, surface, hit.lanes));
        hit.normal = surface.normal;
        hit.leaving = surface.leaving & hit.lanes;
        hit.normal_dir = dot(hit.normal, path.dir);
    }
    // Rounding can't make a shine of a cosine that is below this.
    const vreal<float> floor = hit.material->highlight_floor;
    hit.floor_dir2 = max(floor * floor * vreal<float>(1.0f - 0x1p-18f),
                         vreal<float>(std::numeric_limits<float>::min())) *
                     path.dir2;
    hit.is_far = (far_lanes(tile.plan, hit.point) & hit.lanes) != 0;
}

/// The lanes of `packet.wanted` that see a light.
template <abi::Features F>
inline std::uint32_t lit_lanes(const FusedTile<F>& tile, int number, const PacketWork& work,
                               const LightPacket<float>& packet, const vreal<float>& length2,
                               std::uint32_t lit_side)
{
    const HitState& hit = work.hit;
    const abi::LightRecord<float>& light = tile.scene.lighting.lights.data[number];
    const ClearTests& tests = tile.plan.clear[number];
    const std::uint32_t wanted = packet.wanted;
    tile.counts.shadow += static_cast<unsigned>(__builtin_popcount(wanted));
    const bool is_plain =
        tests.complete && !hit.is_far && (wanted & ~lit_side) == 0 && hit.leaving == 0;
    QuickShadow shadow{0, wanted};
    if (is_plain)
        shadow = light.kind == abi::LightKind::point
                     ? shadow_towards(tests, hit, packet.to_light, length2,
                                      length2 * packet.inverse_length, wanted)
                     : shadow_along(tests, hit, packet.to_light, wanted);
    const std::uint32_t clear = wanted & ~shadow.open & ~shadow.blocked;
    if (shadow.open == 0)
        return clear;
    const LightObjects<F, float>* occluders = tile.plan.occluders;
    if (hit.is_far)
        occluders = find_from_far(tile, hit.point, hit.lanes).occluders;
    return clear | trace_to_light(tile, number, occluders, work, packet, shadow.open);
}

/// Adds the light of one source at a packet of hits, in the lanes that see it.
template <abi::Features F>
inline void add_light(const FusedTile<F>& tile, int number, PacketWork& work)
{
    const vreal<float> zero(0.0f);
    const abi::SceneView<float>& scene = tile.scene;
    const abi::LightRecord<float>& light = scene.lighting.lights.data[number];
    const ClearTests& tests = tile.plan.clear[number];
    HitState& hit = work.hit;
    const bool is_point = light.kind == abi::LightKind::point;
    LightPacket<float> packet;
    packet.to_light = broadcast(light.vector);
    vreal<float> length2(tests.length2);
    if (is_point) {
        packet.to_light = packet.to_light - hit.point;
        length2 = dot(packet.to_light, packet.to_light);
    }
    const vreal<float> normal_light = dot(hit.normal, packet.to_light);
    const std::uint32_t lit_side = bits(normal_light > zero) & hit.lanes;
    // What is below the floor by more than rounding shows no highlight, and needs no root.
    const vreal<float> mirror = nmadd(normal_light + normal_light, hit.normal_dir,
                                      dot(packet.to_light, work.path.dir));
    const std::uint32_t shining =
        bits(mirror * abs(mirror) >= hit.floor_dir2 * length2) & hit.lanes;
    if ((lit_side | shining) == 0)
        return;
    packet.inverse_length = is_point ? vreal<float>(1.0f) / sqrt(length2)
                                     : vreal<float>(tests.inverse_length);
    packet.diffuse = max(normal_light, zero) * packet.inverse_length;
    packet.has_highlight = 0;
    if (shining != 0) {
        packet.highlight =
            mirror * packet.inverse_length * (vreal<float>(1.0f) / sqrt(work.path.dir2));
        packet.has_highlight =
            bits((packet.highlight > zero) &
                 (packet.highlight >= hit.material->highlight_floor) &
                 (normal_light > vreal<float>(scene.lighting.highlight_above))) &
            shining;
    }
    packet.wanted = lit_side | packet.has_highlight;
    std::uint32_t lit = packet.wanted;
    if (lit == 0)
        return;
    if (light.casts_shadow)
        lit = lit_lanes(tile, number, work, packet, length2, lit_side);
    if (lit != 0)
        hit.color = hit.color + lit_color<F>(light, packet, *hit.material, lit, tile.counts);
}

/// Adds the light of a packet's hits to the pixels.
template <Generation G, abi::Features F>
inline void add_hits(const FusedTile<F>& tile, PacketWork& work, bool goes_on)
{
    const HitState& hit = work.hit;
    const MaterialPacket<float>& material = *hit.material;
    Vec3v<float> color = hit.color;
    if (goes_on) {
        color = color * material.local;
    } else {
        const Vec3v<float> share = material.reflect + material.transmit;
        color = madd<float>(share, broadcast(tile.scene.rules.limit_color), color);
    }
    PathState& path = work.path;
    if constexpr (G == Generation::mirrored)
        color = path.color + scale<float>(path.weight, color);
    path.color = hit.lanes == all_lanes<float>
                     ? color
                     : select(from_bits<float>(hit.lanes), color, path.color);
}

/// Replaces the rays of a packet by those that its hits mirror.
template <abi::Features F>
inline void mirror_rays(const FusedTile<F>& tile, PacketWork& work)
{
    PathState& path = work.path;
    HitState& hit = work.hit;
    const MaterialPacket<float>& material = *hit.material;
    const std::uint32_t active = hit.lanes & any_channel(material.reflect);
    path.active = active;
    if (active == 0)
        return;
    tile.counts.reflected += static_cast<unsigned>(__builtin_popcount(active));
    const abi::RayRules<float>& rules = tile.scene.rules;
    const Vec3v<float> lift = origin_offset<float>(rules.start_error, hit.point, hit.outward);
    path.dir = madd<float>(hit.normal_dir * vreal<float>(-2.0f), hit.normal, path.dir);
    path.dir2 = dot(path.dir, path.dir);
    path.weight = path.weight * material.reflect.x;
    if (hit.common < 0)
        hit.common = static_cast<std::int32_t>(common_number<float>(hit.number, active));
    path.own = hit.common;
    path.is_far = hit.is_far;
    path.is_plain = tile.plan.has_common_hits && !hit.is_far && hit.common >= 0;
    path.org = hit.point + lift;
    path.meets_own = (hit.leaving & active) != 0 || tile.scene.shapes.hit_again_outside;
    if (!path.meets_own)
        return;
    const std::uint32_t outside = ~hit.leaving;
    path.is_plain = false;
    path.org = select(from_bits<float>(outside & all_lanes<float>), path.org, hit.point - lift);
    path.second = second_hit<float>(tile.scene.shapes, hit.number, hit.point, path.dir,
                                    vreal<float>(rules.secondary_t_min), outside, active);
}

/// Traces a generation of `count` packets, of which some may be done.
template <Generation G, abi::Features F>
inline void trace_generation(const FusedTile<F>& tile, const Candidates& candidates, int count,
                             int depth)
{
    PacketWork* const packets = tile.memory.packets;
    const bool goes_on = depth < tile.scene.rules.max_depth;
    Choice choices[packets_at_once];
    for (int i = 0; i < count; ++i) {
        const PathState& path = packets[i].path;
        choices[i].is_known = false;
        if (path.active != 0 && path.is_plain)
            choices[i] = choose_hit(tile.plan, candidates, rays_of<G>(tile, path), path.own,
                                    path.active);
    }
    for (int i = 0; i < count; ++i) {
        PathState& path = packets[i].path;
        packets[i].hit.lanes = path.active;
        if (path.active == 0)
            continue;
        find_hits<G>(tile, choices[i], packets[i]);
        add_escaped<G>(tile, path, path.active & ~packets[i].hit.lanes);
        path.active = 0;
    }
    for (int i = 0; i < count; ++i)
        if (packets[i].hit.lanes != 0)
            prepare_hits(tile, packets[i]);
    for (int light = 0; light < tile.scene.lighting.lights.count; ++light)
        for (int i = 0; i < count; ++i)
            if (packets[i].hit.lanes != 0)
                add_light(tile, light, packets[i]);
    for (int i = 0; i < count; ++i) {
        if (packets[i].hit.lanes == 0)
            continue;
        add_hits<G>(tile, packets[i], goes_on);
        if (goes_on)
            mirror_rays(tile, packets[i]);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
