#include "scene/scene_builder.hpp"
#include "scene/unit_vector.hpp"
#include "scene/values.hpp"

#include <algorithm>

namespace packtrace::reader {
namespace {

Sphere build_sphere(const Block& block)
{
    Sphere sphere;
    sphere.center = read_point(block.require("center", "(0, 0, 3)"));
    sphere.radius = read_positive(block.require("radius", "1"));
    return sphere;
}

Plane build_plane(const Block& block)
{
    Plane plane;
    plane.point = read_point(block.require("point", "(0, -1, 0)"));
    plane.normal = unit_vector(read_direction(block.require("normal", "(0, 1, 0)")));
    plane_axes(plane);
    return plane;
}

}  // namespace

const Keys& surface_keywords()
{
    static const Keys keywords{"sphere",     "plane",       "ellipsoid",    "cylinder", "cone",
                               "paraboloid", "hyperboloid", "hyperboloid2", "saddle",   "quadric"};
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
    if (keyword == "plane")
        return {"point", "normal"};
    if (keyword == "quadric")
        return {"coefficients", "z_range", "capped"};
    return {"z_range", "capped"};
}

Surface build_surface(const Block& block, std::string_view keyword)
{
    if (keyword == "sphere")
        return build_sphere(block);
    if (keyword == "plane")
        return build_plane(block);
    return build_quadric(block, keyword);
}

}  // namespace packtrace::reader
