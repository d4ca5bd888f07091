#include <cmath>

#include <glm/geometric.hpp>
#include <packtrace/surface.hpp>

namespace packtrace {

void plane_axes(Plane& plane)
{
    const Vec3 size{std::abs(plane.normal.x), std::abs(plane.normal.y), std::abs(plane.normal.z)};
    int major = 0;
    if (size.y > size[major])
        major = 1;
    if (size.z > size[major])
        major = 2;

    Vec3 first{0.0};
    first[major == 0 ? 1 : 0] = 1.0;
    plane.u = glm::normalize(first - plane.normal * glm::dot(plane.normal, first));
    plane.v = glm::cross(plane.u, plane.normal);

    // The second axis points the way its world axis does.
    const int second = major == 2 ? 1 : 2;
    if (plane.v[second] < 0.0)
        plane.v = -plane.v;
}

}  // namespace packtrace
