#include "lower/tree_objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace packtrace {
namespace {

/// An object is far away if its extent is more than this times the median extent.
constexpr double far_factor = 64.0;

/// At most so many far objects, and at most one of so many objects, stay in lists: every packet is
/// tested against all objects of a list.
constexpr std::size_t most_far_objects = 16;
constexpr std::size_t objects_a_far_object = 8;

std::vector<double> extents_of(const SurfaceLists& surfaces)
{
    std::vector<double> extents;
    for_each_surface(surfaces, [&](const auto& surface) {
        if constexpr (requires { box_of(surface); })
            if (fits_tree(surface))
                extents.push_back(extent_of(box_of(surface)));
    });
    return extents;
}

}  // namespace

double extent_of(const CenteredBox& box)
{
    double extent = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        extent = std::max(extent, std::abs(box.center[axis]) + box.half[axis]);
    return extent;
}

double bvh_extent(const SurfaceLists& surfaces)
{
    std::vector<double> extents = extents_of(surfaces);
    if (extents.empty())
        return std::numeric_limits<double>::infinity();
    const auto median = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2);
    std::nth_element(extents.begin(), median, extents.end());
    const double limit = far_factor * *median;
    const auto far_objects = static_cast<std::size_t>(
        std::count_if(median, extents.end(), [&](double extent) { return extent > limit; }));
    const bool are_few =
        far_objects <= std::min(most_far_objects, extents.size() / objects_a_far_object);
    return are_few ? limit : std::numeric_limits<double>::infinity();
}

BvhObjects count_tree_objects(const LoweredScene& lowered)
{
    BvhObjects count;
    for_each_surface(lowered, [&](const auto& surface) {
        using Kind = std::decay_t<decltype(surface)>;
        if (!is_in_bvh(lowered, surface))
            return;
        if constexpr (std::is_same_v<Kind, LoweredSphere>)
            ++count.spheres;
        else if constexpr (std::is_same_v<Kind, LoweredPolygon>)
            ++count.polygons;
        else
            ++count.quadrics;
    });
    return count;
}

}  // namespace packtrace
