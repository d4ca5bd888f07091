#include "lower/tree_objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace packtrace {
namespace {

/// At most so many are left out, and no more than this share: each packet meets lists whole.
constexpr std::size_t most_far_objects = 16;
constexpr std::size_t share_of_far_objects = 8;

/// So many times as far as the median object's reach lies what is left out.
constexpr double far_reach = 64.0;

std::vector<double> reaches_of(const SurfaceLists& surfaces)
{
    std::vector<double> reaches;
    for_each_surface(surfaces, [&](const auto& surface) {
        if constexpr (requires { box_of(surface); })
            if (fits_tree(surface))
                reaches.push_back(reach_of(box_of(surface)));
    });
    return reaches;
}

}  // namespace

double reach_of(const CenteredBox& box)
{
    double reach = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        reach = std::max(reach, std::abs(box.center[axis]) + box.half[axis]);
    return reach;
}

double tree_reach(const SurfaceLists& surfaces)
{
    std::vector<double> reaches = reaches_of(surfaces);
    if (reaches.empty())
        return std::numeric_limits<double>::infinity();
    const auto middle = reaches.begin() + static_cast<std::ptrdiff_t>(reaches.size() / 2);
    std::nth_element(reaches.begin(), middle, reaches.end());
    const double limit = far_reach * *middle;
    const auto beyond = static_cast<std::size_t>(
        std::count_if(middle, reaches.end(), [&](double reach) { return reach > limit; }));
    const bool are_few =
        beyond <= std::min(most_far_objects, reaches.size() / share_of_far_objects);
    return are_few ? limit : std::numeric_limits<double>::infinity();
}

TreeObjects count_tree_objects(const LoweredScene& lowered)
{
    TreeObjects count;
    for_each_surface(lowered, [&](const auto& surface) {
        using Kind = std::decay_t<decltype(surface)>;
        if (!is_in_tree(lowered, surface))
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
