#include "geometry/polygon.hpp"

#include "geometry/kinds.hpp"
#include "scene/polygon_plane.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace packtrace {
namespace {

void bound(LoweredPolygon& polygon)
{
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (const auto& corner : polygon.corners) {
        low = glm::min(low, widen(corner.position));
        high = glm::max(high, widen(corner.position));
    }
    // Far more than the rounding error of the bound itself.
    constexpr double slack = 1.0 + 1e-9;
    polygon.bound = 0.5 * low + 0.5 * high;
    polygon.box_half = slack * glm::max(high - polygon.bound, polygon.bound - low);
    for (const auto& corner : polygon.corners)
        polygon.bound_radius = std::max(
            polygon.bound_radius, slack * glm::length(widen(corner.position) - polygon.bound));
}

void add_contour(const std::vector<Vec3>& contour, const Mat4& transform, LoweredPolygon& polygon)
{
    const std::size_t start = polygon.corners.size();
    for (const Vec3& own : contour) {
        abi::PolygonCorner<double> corner{};
        round_to(corner.position, Vec3(transform * glm::dvec4(own, 1.0)));
        corner.starts_contour = polygon.corners.size() == start ? 1 : 0;
        polygon.corners.push_back(corner);
    }
    polygon.corners.push_back(polygon.corners[start]);
    polygon.corners.back().starts_contour = 0;
}

}  // namespace

int lower_kind(const Object& object, const Polygon& polygon, std::int32_t surface,
               SurfaceLists& lists)
{
    LoweredPolygon result;
    for (const std::vector<Vec3>& contour : polygon.contours)
        add_contour(contour, object.transform, result);
    result.normal = placed_normal(polygon, Mat3(object.transform));
    bound(result);
    result.surface = surface;
    lists.polygons.push_back(std::move(result));
    return 1;
}

std::vector<double> key_of(const LoweredPolygon& polygon)
{
    std::vector<double> key{polygon.normal.x, polygon.normal.y, polygon.normal.z};
    for (const auto& corner : polygon.corners) {
        key.insert(key.end(), std::begin(corner.position), std::end(corner.position));
        key.push_back(corner.starts_contour);
    }
    return key;
}

template <class Real>
abi::PolygonRecord<Real> pack(const LoweredPolygon& polygon)
{
    abi::PolygonRecord<Real> packed;
    round_to(packed.normal, polygon.normal);
    round_to(packed.point, widen(polygon.corners[0].position));
    round_to(packed.bound, polygon.bound);
    // Enlarge the ball, because rounding moves the centre and the corners.
    const Vec3 size = glm::abs(polygon.bound);
    const double moved = 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) *
                         (size.x + size.y + size.z + polygon.bound_radius);
    packed.bound_radius = static_cast<Real>(polygon.bound_radius + moved);
    packed.corners = nullptr;
    packed.corner_count = static_cast<std::int32_t>(polygon.corners.size());
    packed.surface = polygon.surface;
    return packed;
}

template <class Real>
PackedCorners<Real>::PackedCorners(std::span<const LoweredPolygon* const> polygons,
                                   std::span<abi::PolygonRecord<Real>> records)
{
    std::size_t count = 0;
    for (const LoweredPolygon* polygon : polygons)
        count += polygon->corners.size();
    corners_ = AlignedArray<abi::PolygonCorner<Real>>(count);
    abi::PolygonCorner<Real>* next = corners_.data();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        records[i].corners = next;
        for (const abi::PolygonCorner<double>& corner : polygons[i]->corners) {
            round_to(next->position, widen(corner.position));
            next->starts_contour = corner.starts_contour;
            ++next;
        }
    }
}

template abi::PolygonRecord<float> pack(const LoweredPolygon&);
template abi::PolygonRecord<double> pack(const LoweredPolygon&);
template class PackedCorners<float>;
template class PackedCorners<double>;

}  // namespace packtrace
