#pragma once

#include "geometry/plane.hpp"
#include "geometry/polygon.hpp"
#include "geometry/quadric.hpp"
#include "geometry/sphere.hpp"

#include <tuple>
#include <utility>
#include <vector>

// The kinds of surfaces, with one list for each. Code for all kinds loops over the lists at compile
// time, and calls overloads that are in the file of each kind.
namespace packtrace {

/// Surfaces in world space.
struct SurfaceLists {
    std::vector<LoweredSphere> spheres;  ///< in ascending order of surface numbers, as all lists
    std::vector<LoweredAnchoredSphere> anchored_spheres;
    std::vector<LoweredPlane> planes;
    std::vector<LoweredQuadric> quadrics;
    std::vector<LoweredPolygon> polygons;
};

inline constexpr std::tuple surface_lists(&SurfaceLists::spheres, &SurfaceLists::anchored_spheres,
                                          &SurfaceLists::planes, &SurfaceLists::quadrics,
                                          &SurfaceLists::polygons);
inline constexpr std::size_t kind_count = std::tuple_size_v<decltype(surface_lists)>;

/// Calls `visit` with the member pointer of every list.
template <class Visit>
void for_each_kind(const Visit& visit)
{
    std::apply([&](auto... list) { (visit(list), ...); }, surface_lists);
}

/// Calls `visit` with every list.
template <class Lists, class Visit>
void for_each_list(Lists& lists, const Visit& visit)
{
    for_each_kind([&](auto list) { visit(lists.*list); });
}

/// Calls `visit` with every surface, kind by kind.
template <class Lists, class Visit>
void for_each_surface(Lists& lists, const Visit& visit)
{
    for_each_list(lists, [&](auto& list) {
        for (auto& surface : list)
            visit(surface);
    });
}

template <class Kind>
[[nodiscard]] auto shape_of(const Kind& surface)
{
    return pack<double>(surface);
}

template <class List>
struct KindOfList;
template <class Kind>
struct KindOfList<std::vector<Kind> SurfaceLists::*> {
    using type = Kind;
};

/// The kind of the list that a member pointer selects.
template <class List>
using KindOf = typename KindOfList<List>::type;

/// The record by which a surface is refined and shaded.
template <class Kind>
using ShapeOf = decltype(shape_of(std::declval<const Kind&>()));

}  // namespace packtrace
