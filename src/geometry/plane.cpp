#include "geometry/plane.hpp"

#include "geometry/kinds.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <limits>

namespace packtrace {

int lower_kind(const Object& object, const Plane& plane, std::int32_t surface, SurfaceLists& lists)
{
    LoweredPlane result{.point = Vec3(object.transform * glm::dvec4(plane.point, 1.0))};
    const Mat3 normal_map = glm::transpose(glm::inverse(Mat3(object.transform)));
    result.normal = glm::normalize(normal_map * plane.normal);
    result.surface = surface;
    lists.planes.push_back(result);
    return 1;
}

Exit exit_of(const LoweredPlane& plane, const Vec3& eye, const Vec3& forward)
{
    const double height = glm::dot(plane.normal, eye - plane.point);
    if (!(height < 0.0))
        return std::nullopt;
    const double t = -height / glm::dot(plane.normal, forward);
    return t > 0.0 ? t : std::numeric_limits<double>::infinity();
}

template <class Real>
abi::PlaneRecord<Real> pack(const LoweredPlane& plane)
{
    abi::PlaneRecord<Real> packed;
    round_to(packed.point, plane.point);
    round_to(packed.normal, plane.normal);
    packed.surface = plane.surface;
    return packed;
}

template abi::PlaneRecord<float> pack(const LoweredPlane&);
template abi::PlaneRecord<double> pack(const LoweredPlane&);

}  // namespace packtrace
