#pragma once

#include "lower/lowered_scene.hpp"

#include <cstddef>

// Which objects of a scene are in its BVH. The others stay in lists.
namespace packtrace {

/// The largest magnitude of a coordinate in the box.
[[nodiscard]] double extent_of(const CenteredBox& box);

/// The largest extent of an object in the BVH of a scene; infinite where none is too far away.
/// Tests widen all boxes by a rounding error that grows with the largest coordinate in the BVH. A
/// few objects very far away would make this error larger than the other boxes, so they stay in
/// lists.
[[nodiscard]] double bvh_extent(const SurfaceLists& surfaces);

/// Whether the surface is in the BVH, if there is one.
template <class Kind>
[[nodiscard]] bool is_in_bvh(const LoweredScene& lowered, const Kind& surface)
{
    if constexpr (requires { box_of(surface); })
        return fits_tree(surface) && extent_of(box_of(surface)) <= lowered.bvh_extent;
    else
        return false;
}

/// How many objects of a scene can be in a BVH.
struct BvhObjects {
    std::size_t spheres = 0;
    std::size_t quadrics = 0;
    std::size_t polygons = 0;

    [[nodiscard]] std::size_t all() const
    {
        return spheres + quadrics + polygons;
    }
};

[[nodiscard]] BvhObjects count_tree_objects(const LoweredScene& lowered);

}  // namespace packtrace
