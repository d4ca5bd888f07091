#pragma once

#include "lower/lowered_scene.hpp"

#include <cstddef>

// Which objects of a scene its hierarchy holds. The others stay in lists.
namespace packtrace {

/// The largest coordinate, in size, of what a box holds.
[[nodiscard]] double reach_of(const CenteredBox& box);

/// How far from the world's origin the hierarchy over a scene's surfaces reaches. Boxes are met
/// with room for rounding by the largest coordinate of all: the few that are very far from where
/// the rest is are left out, lest boxes of the rest have more room than size.
[[nodiscard]] double tree_reach(const SurfaceLists& surfaces);

/// Whether the hierarchy, if there is one, holds the surface.
template <class Kind>
[[nodiscard]] bool is_in_tree(const LoweredScene& lowered, const Kind& surface)
{
    if constexpr (requires { box_of(surface); })
        return fits_tree(surface) && reach_of(box_of(surface)) <= lowered.tree_reach;
    else
        return false;
}

/// How many objects of a scene can be in a hierarchy.
struct TreeObjects {
    std::size_t spheres = 0;
    std::size_t quadrics = 0;
    std::size_t polygons = 0;

    [[nodiscard]] std::size_t all() const
    {
        return spheres + quadrics + polygons;
    }
};

[[nodiscard]] TreeObjects count_tree_objects(const LoweredScene& lowered);

}  // namespace packtrace
