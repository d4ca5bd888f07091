#include "lower/packed_scene.hpp"

#include "core/in_parallel.hpp"
#include "geometry/object_rules.hpp"
#include "lower/far_lights.hpp"
#include "lower/tree_objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace packtrace {
namespace {

// From how many objects on a BVH is faster than lists (results/crossover.json).

/// Streams: a BVH is faster for camera and shadow rays from 12 spheres on, for bounced rays from
/// 100.
constexpr std::size_t stream_bvh_objects = 32;

/// Quadrics and polygons with error bounds: a BVH is faster for camera rays from 40 on, for rays of
/// all directions from 600. So this many count as one sphere.
constexpr std::size_t bounded_objects_a_sphere = 4;

/// Frames: a tile selects objects from lists by its cone and tests them a packet at a time. So the
/// wider the packets, the longer lists are faster.
constexpr std::size_t frame_bvh_objects(int lanes)
{
    return lanes >= 16 ? 160 : lanes >= 8 ? 128 : 96;
}

/// Frames without mirrors and glass have only rays that start or end together. For all packet
/// widths a BVH is faster from 40 spheres on if these hide each other, from 160 if they are far
/// apart (results/crossover_fast.json).
constexpr std::size_t plain_frame_bvh_objects = 112;

/// The same in exact mode, for spheres or quadrics. Error bounds of lists are computed once for a
/// tile, those of a BVH for each bundle of rays and leaf (lists_of_frames_without_mirrors in
/// results/tree_designs.json).
constexpr std::size_t exact_plain_frame_bvh_objects = 384;

/// A mesh is as fast through a BVH from about 80 polygons on (same figures), so a polygon counts as
/// this many spheres.
constexpr std::size_t plain_objects_a_polygon = 4;

/// A light buffer pays for being built from this many spread shadow rays for each block of spheres
/// on if the spheres are spread evenly, from a quarter as many on if they crowd
/// (light_buffers_of_large_scenes in results/tree_designs.json).
constexpr double light_buffer_rays = 75.0;

/// The ray origin offset in unit roundoffs. Hits in single precision are refined in double and
/// rounded once, and their offset origin once more. Hits in double are not refined.
/// docs/numerics_derivations.md derives both.
template <class Real>
constexpr Real start_roundoffs = sizeof(Real) == sizeof(float) ? Real(4) : Real(32);

/// The least cosine of a highlight is made smaller by this share, so that the kernels' own power,
/// which is rounded, is 0 below it.
constexpr double highlight_floor_margin = 1e-6;

bool certifiable(const LoweredScene& lowered)
{
    bool all = true;
    for_each_surface(lowered, [&](const auto& surface) { all = all && is_certifiable(surface); });
    return all;
}

/// `least` is the number of objects from which on a BVH is faster.
Traversal chosen(Traversal traversal, std::size_t objects, std::size_t least)
{
    if (traversal != Traversal::automatic)
        return traversal;
    return objects >= least ? Traversal::tree : Traversal::list;
}

/// The number of objects that a BVH can hold, each counted by how much a BVH gains for it.
template <class Real>
std::size_t weighted_bvh_objects(const LoweredScene& lowered)
{
    const BvhObjects objects = count_tree_objects(lowered);
    const bool with_bounds = sizeof(Real) == sizeof(float) && lowered.features.exact;
    return objects.spheres +
           (objects.quadrics + objects.polygons) / (with_bounds ? bounded_objects_a_sphere : 1);
}

template <class Real>
PackedTree<Real> pack_bvh(const LoweredScene& lowered, Traversal traversal, Bvh* keep)
{
    const Traversal by = chosen(traversal, weighted_bvh_objects<Real>(lowered), stream_bvh_objects);
    return by == Traversal::tree ? PackedTree<Real>(lowered, keep) : PackedTree<Real>();
}

/// The objects that lists hold beside a BVH, which may be empty.
template <class Real>
Listed listed_beside(const PackedTree<Real>& bvh)
{
    return bvh.view().empty() ? Listed::all : Listed::outside_bvh;
}

/// Below this cosine the highlight is less than the smallest normal number and counts as 0.
template <class Real>
Real highlight_floor(const LoweredMaterial& material)
{
    if (material.highlight == Rgb(0.0))
        return std::numeric_limits<Real>::infinity();
    const double smallest = std::numeric_limits<Real>::min_exponent - 1;
    return static_cast<Real>(std::exp2(smallest / material.shininess) *
                             (1.0 - highlight_floor_margin));
}

template <class Real>
abi::MaterialRecord<Real> pack_material(const LoweredMaterial& material)
{
    abi::MaterialRecord<Real> packed;
    round_to(packed.ambient, material.ambient);
    round_to(packed.diffuse, material.diffuse);
    round_to(packed.highlight, material.highlight);
    round_to(packed.reflect, material.reflect);
    round_to(packed.local, material.local);
    round_to(packed.transmit, material.transmit);
    packed.shininess = static_cast<Real>(material.shininess);
    packed.highlight_floor = highlight_floor<Real>(material);
    return packed;
}

/// Whether each surface has the number of its object, so that kernels need not look it up.
bool are_objects(const std::vector<abi::MaterialIndex>& surfaces)
{
    std::int32_t number = 0;
    return std::all_of(surfaces.begin(), surfaces.end(),
                       [&](const abi::MaterialIndex& index) { return index.object == number++; });
}

}  // namespace

Traversal frame_traversal(const LoweredScene& lowered, Traversal traversal, int lanes)
{
    const BvhObjects objects = count_tree_objects(lowered);
    if (lowered.bounces && lowered.max_depth > 0)
        return chosen(traversal, objects.all(), frame_bvh_objects(lanes));
    if (!lowered.features.exact)
        return chosen(traversal, objects.all(), plain_frame_bvh_objects);
    return chosen(traversal,
                  objects.spheres + objects.quadrics + objects.polygons * plain_objects_a_polygon,
                  exact_plain_frame_bvh_objects);
}

LoweredScene shadow_casters(const LoweredScene& lowered)
{
    const auto& casts = lowered.casts_shadow;
    LoweredScene casters = lowered;
    casters.casts_shadow.clear();
    const auto casts_none = [&](const auto& surface) {
        return !casts[static_cast<std::size_t>(surface.surface)];
    };
    for_each_list(casters, [&](auto& list) { std::erase_if(list, casts_none); });
    return casters;
}

template <class Real>
PackedScene<Real>::PackedScene(const LoweredScene& lowered, Traversal traversal, Bvh* keep)
    : bvh_(pack_bvh<Real>(lowered, traversal, keep)),
      lists_(lowered, listed_beside(bvh_)),
      shapes_(lowered)
{
    bvh_.set_shapes(shapes_.view());
    view_.tree = bvh_.view();
    lists_.show(view_);
    view_.shapes = shapes_.view();
    if (sizeof(Real) == sizeof(float))
        view_.certifiable = certifiable(lowered);
    if (sizeof(Real) == sizeof(float) && lowered.features.exact)
        pack_wide(lowered);
    pack_materials(lowered);
    pack_ior(lowered);
    pack_lights(lowered);
    pack_casters(lowered);
    pack_rules(lowered);
    pack_min_weight(lowered);
}

template <class Real>
void PackedScene<Real>::pack_rules(const LoweredScene& lowered)
{
    round_to(view_.rules.background, lowered.background);
    round_to(view_.rules.limit_color, lowered.limit_color);
    view_.rules.max_depth = lowered.max_depth;
    view_.lighting.flat = lowered.flat;
    view_.lighting.transparent_shadows = lowered.transparent_shadows;
    if (lowered.visible_lights)
        view_.lighting.seen_within = static_cast<Real>(lowered.epsilon);
    view_.rules.units = lowered.units;
    view_.lighting.highlight_above =
        lowered.highlights_behind ? -std::numeric_limits<Real>::infinity() : Real(0);
    if (lowered.self_hits == SelfHits::note)
        view_.rules.secondary_t_min = static_cast<Real>(lowered.epsilon);
    else
        view_.rules.start_error = start_roundoffs<Real> * std::numeric_limits<Real>::epsilon() / 2;
}

template <class Real>
void PackedScene<Real>::refit(const LoweredScene& lowered, const Bvh& bvh)
{
    bvh_.refit(lowered, bvh);
    shapes_.move(lowered);
    view_.tree = bvh_.view();
    view_.shapes = shapes_.view();
    if (sizeof(Real) == sizeof(float))
        view_.certifiable = certifiable(lowered);
    if (view_.wide == nullptr)
        return;
    wide_.tree = bvh_.wide_view(shapes_.view());
    choose_light_ends(lowered);
}

template <class Real>
void PackedScene<Real>::pack_wide(const LoweredScene& lowered)
{
    wide_lists_ = std::make_unique<PackedLists<double>>(lowered, listed_beside(bvh_));
    wide_lists_->show(wide_);
    if (!bvh_.view().empty())
        wide_.tree = bvh_.wide_view(shapes_.view());
    view_.wide = &wide_;
}

template <class Real>
void PackedScene<Real>::pack_materials(const LoweredScene& lowered)
{
    const auto& surfaces = lowered.material_index;
    material_index_ = AlignedArray<abi::MaterialIndex>::unset(surfaces.size());
    for_each_in_parallel(surfaces, [&](const abi::MaterialIndex& index) {
        material_index_[static_cast<std::size_t>(&index - surfaces.data())] = index;
    });
    materials_ = AlignedArray<abi::MaterialRecord<Real>>(lowered.materials.size());
    for (std::size_t i = 0; i < lowered.materials.size(); ++i)
        materials_[i] = pack_material<Real>(lowered.materials[i]);
    checkers_ = AlignedArray<abi::CheckerRecord<Real>>(lowered.checkers.size());
    for (std::size_t i = 0; i < lowered.checkers.size(); ++i) {
        round_to(checkers_[i].point, lowered.checkers[i].point);
        round_to(checkers_[i].u, lowered.checkers[i].u);
        round_to(checkers_[i].v, lowered.checkers[i].v);
    }
    view_.materials.of_surface = material_index_.data();
    view_.materials.surfaces_are_objects = are_objects(surfaces);
    view_.materials.records = materials_.data();
    view_.materials.checkers = lowered.checkers.empty() ? nullptr : checkers_.data();
}

template <class Real>
void PackedScene<Real>::pack_min_weight(const LoweredScene& lowered)
{
    if (lowered.min_weight <= 0.0)
        return;
    const std::vector<Rgb> light = most_light(lowered);
    most_light_ = AlignedArray<abi::MostLight>(light.size());
    for (std::size_t i = 0; i < light.size(); ++i)
        most_light_[i] = {{light[i].x, light[i].y, light[i].z}};
    view_.rules.min_weight = static_cast<Real>(lowered.min_weight);
    view_.rules.most_light = most_light_.data();
}

/// By object in scenes with glass; else that of the world alone. The world has number -1.
template <class Real>
void PackedScene<Real>::pack_ior(const LoweredScene& lowered)
{
    const auto& surfaces = lowered.material_index;
    const bool objects = lowered.features.glass && !surfaces.empty();
    ior_ = AlignedArray<Real>(objects ? static_cast<std::size_t>(surfaces.back().object) + 2 : 1);
    ior_[0] = 1;
    view_.materials.ior = ior_.data() + 1;
    if (!objects)
        return;
    for (const abi::MaterialIndex& index : surfaces)
        ior_[static_cast<std::size_t>(index.object) + 1] =
            static_cast<Real>(lowered.materials[static_cast<std::size_t>(index.first)].ior);
}

template <class Real>
void PackedScene<Real>::pack_lights(const LoweredScene& lowered)
{
    lights_ = AlignedArray<abi::LightRecord<Real>>(lowered.lights.size());
    for (std::size_t i = 0; i < lowered.lights.size(); ++i) {
        const Light& light = lowered.lights[i];
        round_to(lights_[i].intensity, light.intensity);
        round_to(lights_[i].vector, light.vector);
        lights_[i].kind =
            light.type == LightType::point ? abi::LightKind::point : abi::LightKind::directional;
        lights_[i].casts_shadow = lowered.shadows && light.casts_shadow;
    }
    choose_light_ends(lowered);
    view_.lighting.lights = {lights_.data(), static_cast<int>(lowered.lights.size())};
}

template <class Real>
void PackedScene<Real>::choose_light_ends(const LoweredScene& lowered)
{
    const bool exact = view_.wide != nullptr;
    for (std::size_t i = 0; i < lowered.lights.size(); ++i) {
        abi::LightRecord<Real>& light = lights_[i];
        light.sends_rays =
            light.kind == abi::LightKind::point &&
            !(exact && light.casts_shadow && is_far(lowered.lights[i].vector, lowered));
    }
}

template <class Real>
void PackedScene<Real>::pack_casters(const LoweredScene& lowered)
{
    if (!lowered.shadows || lowered.casts_shadow.empty())
        return;
    // Without a BVH for camera rays there are no bundles of shadow rays either.
    casters_ = std::make_unique<PackedScene>(
        shadow_casters(lowered), bvh_.view().empty() ? Traversal::list : Traversal::automatic);
    // A light may be far from the casters, but not from all objects.
    for (std::size_t i = 0; i < lights_.size(); ++i)
        casters_->lights_[i].sends_rays = lights_[i].sends_rays;
    view_.casters = &casters_->view();
}

template <class Real>
double PackedScene<Real>::rays_for_light_buffer() const
{
    const bool possible = sizeof(Real) == sizeof(float) && view_.wide != nullptr &&
                          !view_.tree.empty() && bvh_.holds_spheres_alone();
    return possible ? light_buffer_rays * static_cast<double>(bvh_.block_count())
                    : std::numeric_limits<double>::infinity();
}

template <class Real>
PackedLightBuffer PackedScene<Real>::light_buffer(const abi::LightRecord<Real>& light) const
{
    if constexpr (sizeof(Real) == sizeof(float))
        if (light.kind == abi::LightKind::directional || light.sends_rays)
            return {light, view_.tree, bvh_.block_count()};
    return {};
}

template class PackedScene<float>;
template class PackedScene<double>;

}  // namespace packtrace
