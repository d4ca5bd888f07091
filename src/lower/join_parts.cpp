#include "lower/join_parts.hpp"

#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

namespace packtrace {
namespace {

/// Where a part's lists begin in the whole scene's.
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

/// Appends a part's materials; returns their new numbers.
MaterialNumbers join_materials(const LoweredScene& part, RecentMaterials& recent,
                               LoweredScene& whole)
{
    MaterialNumbers numbers;
    for (const LoweredMaterial& material : part.materials) {
        // The two of a checker stay side by side.
        if (part.checkers.empty()) {
            numbers.push_back(recent.place_of(material, whole.materials));
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

}  // namespace

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

}  // namespace packtrace
