#include <algorithm>
#include <string>

#include <glm/geometric.hpp>

#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

namespace packtrace {
namespace {

Sphere build_sphere(const Block& block)
{
    Sphere sphere;
    sphere.center = read_point(block.require("center", "(0, 0, 3)"));
    sphere.radius = read_positive(block.require("radius", "1"));
    return sphere;
}

/// Divides by the largest component first: no length under- or overflows.
Vec3 unit(const Vec3& direction)
{
    const double largest =
        std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    return glm::normalize(direction / largest);
}

Plane build_plane(const Block& block)
{
    Plane plane;
    plane.point = read_point(block.require("point", "(0, -1, 0)"));
    plane.normal = unit(read_direction(block.require("normal", "(0, 1, 0)")));
    plane_axes(plane);
    return plane;
}

}  // namespace

const Keys& surface_keywords()
{
    static const Keys keywords{"sphere", "plane"};
    return keywords;
}

bool is_surface(std::string_view keyword)
{
    const Keys& all = surface_keywords();
    return std::find(all.begin(), all.end(), keyword) != all.end();
}

Keys surface_keys(std::string_view keyword)
{
    if (keyword == "sphere")
        return {"center", "radius"};
    return {"point", "normal", "checker"};
}

Surface build_surface(const Block& block, std::string_view keyword)
{
    if (keyword == "sphere")
        return build_sphere(block);
    return build_plane(block);
}

}  // namespace packtrace
