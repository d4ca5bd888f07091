#include "lower/lower_shading.hpp"
#include "lower/lowered_scene.hpp"
#include "lower/prune.hpp"
#include "lower/tree_objects.hpp"
#include "scene/casting_objects.hpp"
#include <packtrace/validate.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <variant>
#include <vector>

// Runs of objects are lowered in parallel and joined in order.
namespace packtrace {
namespace {

/// By surface whether it casts a shadow; empty where all do.
std::vector<bool> casting_surfaces(const Scene& scene, const LoweredScene& lowered)
{
    const std::vector<bool> objects = casting_objects(scene);
    std::vector<bool> casts;
    if (!objects.empty())
        for (const abi::MaterialIndex& index : lowered.material_index)
            casts.push_back(objects[static_cast<std::size_t>(index.object)]);
    return casts;
}

/// Where the lists of a part begin in the lists of the whole scene.
struct Place {
    std::array<std::size_t, kind_count> lists{};
    std::size_t checkers = 0;
    std::size_t surfaces = 0;

    [[nodiscard]] Place behind(const LoweredScene& part) const
    {
        Place place{lists, checkers + part.checkers.size(), surfaces + part.material_index.size()};
        std::size_t kind = 0;
        for_each_list(part, [&](const auto& list) { place.lists[kind++] += list.size(); });
        return place;
    }
};

using MaterialNumbers = std::vector<std::int32_t>;

/// Appends the materials of a part; returns their new numbers.
MaterialNumbers join_materials(const LoweredScene& part, RecentMaterials& recent,
                               LoweredScene& whole)
{
    MaterialNumbers numbers;
    for (const LoweredMaterial& material : part.materials) {
        // The two materials of a checker stay next to each other.
        if (part.checkers.empty()) {
            numbers.push_back(recent.index_of(material, whole.materials));
        } else {
            numbers.push_back(static_cast<std::int32_t>(whole.materials.size()));
            whole.materials.push_back(material);
        }
    }
    return numbers;
}

template <class Surface>
void join_surfaces(const std::vector<Surface>& part, std::size_t at, std::size_t first_surface,
                   std::vector<Surface>& whole)
{
    for (const Surface& surface : part) {
        Surface& joined = whole[at++];
        joined = surface;
        joined.surface += static_cast<std::int32_t>(first_surface);
    }
}

void join_part(const LoweredScene& part, const Place& at, const MaterialNumbers& materials,
               LoweredScene& whole)
{
    std::size_t kind = 0;
    for_each_kind(
        [&](auto list) { join_surfaces(part.*list, at.lists[kind++], at.surfaces, whole.*list); });
    std::copy(part.checkers.begin(), part.checkers.end(), whole.checkers.data() + at.checkers);
    std::copy(part.faces_viewer.begin(), part.faces_viewer.end(),
              whole.faces_viewer.data() + at.surfaces);
    for (std::size_t i = 0; i < part.material_index.size(); ++i) {
        abi::MaterialIndex index = part.material_index[i];
        index.first = materials[static_cast<std::size_t>(index.first)];
        if (index.checker >= 0)
            index.checker += static_cast<std::int32_t>(at.checkers);
        whole.material_index[at.surfaces + i] = index;
    }
}

void resize(const Place& size, LoweredScene& whole)
{
    std::size_t kind = 0;
    for_each_list(whole, [&](auto& list) { list.resize(size.lists[kind++]); });
    whole.checkers.resize(size.checkers);
    whole.material_index.resize(size.surfaces);
    whole.faces_viewer.resize(size.surfaces);
}

void clear(LoweredScene& part)
{
    for_each_list(part, [](auto& list) { list.clear(); });
    part.checkers.clear();
    part.materials.clear();
    part.material_index.clear();
    part.faces_viewer.clear();
}

/// Appends the parts in order. Each part has its surfaces, materials and checkers numbered from 0;
/// `recent` knows the materials of the whole scene. Leaves the lists of the parts empty, with their
/// memory.
void join_parts(std::span<LoweredScene> parts, RecentMaterials& recent, LoweredScene& whole)
{
    std::vector<Place> places(1, Place{}.behind(whole));
    std::vector<MaterialNumbers> materials;
    for (const LoweredScene& part : parts) {
        places.push_back(places.back().behind(part));
        materials.push_back(join_materials(part, recent, whole));
    }
    resize(places.back(), whole);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        join_part(parts[i], places[i], materials[i], whole);
        clear(parts[i]);
    });
}

/// Objects that one task lowers. The numbers of materials depend on it; pictures do not.
constexpr std::size_t part_objects = 4096;

/// Parts that are lowered before they are joined: few enough for the caches.
constexpr std::size_t parts_at_once = 16;

void lower_part(const Scene& scene, std::size_t begin, std::size_t end, LoweredScene& part)
{
    const LightSums lights = sum_lights(scene);
    RecentMaterials recent;
    for (std::size_t i = begin; i < end; ++i) {
        const Object& object = scene.objects[i];
        const auto number = static_cast<std::int32_t>(i);
        const auto index = lower_material(object, number, lights, recent, part);
        const auto first = static_cast<std::int32_t>(part.material_index.size());
        const auto pieces = static_cast<std::size_t>(std::visit(
            [&](const auto& surface) { return lower_kind(object, surface, first, part); },
            object.surface));
        part.material_index.insert(part.material_index.end(), pieces, index);
        part.faces_viewer.insert(part.faces_viewer.end(), pieces,
                                 normal_faces_viewer(scene, object) ? 1 : 0);
    }
}

/// Lowers the objects from `begin` on, as many as the parts hold.
void lower_parts(const Scene& scene, std::size_t begin, std::span<LoweredScene> parts)
{
    const std::size_t objects = scene.objects.size();
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        lower_part(scene, std::min(objects, begin + i * part_objects),
                   std::min(objects, begin + (i + 1) * part_objects), parts[i]);
    });
}

void lower_objects(const Scene& scene, LoweredScene& lowered)
{
    const std::size_t objects = scene.objects.size();
    std::array<LoweredScene, parts_at_once> parts;
    RecentMaterials recent;
    lowered.spheres.reserve(objects);
    lowered.material_index.reserve(objects);
    for (std::size_t begin = 0; begin < objects; begin += parts_at_once * part_objects) {
        lower_parts(scene, begin, parts);
        join_parts(parts, recent, lowered);
    }
}

/// The glass objects around the eye, in the order in which a ray along `forward` leaves them; at
/// equal distance the lower object number first. At most glass_depth.
std::vector<std::int32_t> glass_around(const Vec3& eye, const Vec3& forward,
                                       const LoweredScene& lowered)
{
    std::vector<std::pair<double, std::int32_t>> exits;
    for_each_surface(lowered, [&](const auto& surface) {
        const auto& index = lowered.material_index[static_cast<std::size_t>(surface.surface)];
        const auto& material = lowered.materials[static_cast<std::size_t>(index.first)];
        if (material.transmit == Rgb(0.0))
            return;
        if (const Exit exit = exit_of(surface, eye, forward))
            exits.emplace_back(*exit, index.object);
    });
    std::sort(exits.begin(), exits.end());
    // If there are too many, the outermost ones count, as if the ray had entered them one by one.
    const std::size_t depth = abi::glass_depth;
    const std::size_t skip = exits.size() > depth ? exits.size() - depth : 0;
    std::vector<std::int32_t> inside;
    for (std::size_t i = skip; i < exits.size(); ++i)
        inside.push_back(exits[i].second);
    return inside;
}

}  // namespace

LoweredScene lower(const Scene& scene, Accuracy accuracy, SelfHits self_hits)
{
    validate(scene);
    LoweredScene lowered;
    lower_model_rules(scene, lowered);
    lower_objects(scene, lowered);
    part_anchored_spheres(lowered);
    lowered.bvh_extent = bvh_extent(lowered);
    lowered.self_hits = self_hits;
    lowered.casts_shadow = casting_surfaces(scene, lowered);

    lowered.features.exact = accuracy == Accuracy::exact;
    find_features(lowered);
    lowered.transparent_shadows =
        scene.shadows == ShadowKind::transparent && lowered.features.glass;
    if (lowered.features.glass)
        lowered.eye_inside = glass_around(scene.camera.position, scene.camera.rotation[2], lowered);
    return lowered;
}

}  // namespace packtrace
