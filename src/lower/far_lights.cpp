#include "lower/far_lights.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace packtrace {
namespace {

/// A direction in single precision is off by 2^-24 of its length in each coordinate.
constexpr double largest_distance = 0x1p14;

}  // namespace

bool is_far(const Vec3& light, const LoweredScene& lowered)
{
    bool bounded = false;
    bool far = false;
    const auto is_far_from = [&](const auto& surface) {
        if (!fits_tree(surface) ||
            (!lowered.casts_shadow.empty() &&
             !lowered.casts_shadow[static_cast<std::size_t>(surface.surface)]))
            return false;
        bounded = true;
        if constexpr (requires { box_of(surface); }) {
            const CenteredBox box = box_of(surface);
            const double size = std::max({box.half.x, box.half.y, box.half.z});
            const Vec3 way = box.center - light;
            return glm::dot(way, way) > largest_distance * largest_distance * size * size;
        }
        return false;
    };
    for_each_list(lowered, [&](const auto& list) {
        far = far || std::any_of(list.begin(), list.end(), is_far_from);
    });
    return far || !bounded;
}

}  // namespace packtrace
