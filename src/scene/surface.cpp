#include "core/quad.hpp"
#include "core/text.hpp"
#include "scene/exact_minor.hpp"
#include "scene/polygon_plane.hpp"
#include "scene/vectors.hpp"
#include <packtrace/surface.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

// The axes of planes, and the planes of polygons.
namespace packtrace {
namespace {

/// The largest distance of a corner from the plane, as a share of the polygon's size. Corners
/// written with seven digits are within it.
constexpr double flatness = 1e-6;

/// The smallest area of a polygon, as a share of its squared size.
constexpr double least_area = 1e-12;

using Contour = std::vector<Vec3>;

template <class Real>
struct Components {
    Real of[3];
};

/// The sum of the edges' cross products, whose length is twice the area. Corners are relative to
/// the first one, so that a polygon far from the origin loses no digits.
template <class Real>
Components<Real> newell_sum(const Contour& contour)
{
    Components<Real> sum{};
    const auto to = [&](std::size_t corner, int axis) {
        return Real{contour[corner][axis]} - Real{contour[0][axis]};
    };
    for (std::size_t i = 1; i + 1 < contour.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const int y = (axis + 1) % 3;
            const int z = (axis + 2) % 3;
            sum.of[axis] += to(i, y) * to(i + 1, z) - to(i, z) * to(i + 1, y);
        }
    return sum;
}

template <class Real>
Vec3 rounded(const Components<Real>& v)
{
    return {static_cast<double>(v.of[0]), static_cast<double>(v.of[1]),
            static_cast<double>(v.of[2])};
}

/// The sum of the products of the edges' lengths, an upper bound of newell_sum(). Their ratio tells
/// how many digits cancel.
double newell_size(const Contour& contour)
{
    double size = 0.0;
    for (std::size_t i = 1; i + 1 < contour.size(); ++i)
        size += glm::length(contour[i] - contour[0]) * glm::length(contour[i + 1] - contour[0]);
    return size;
}

/// A sum in double has enough digits if it is more than this share of the sum of its terms' sizes.
constexpr double certain = 1.0 / 64.0;

/// newell_sum() in double; in more digits for slivers and for contours that cross themselves.
Vec3 newell_normal(const Contour& contour)
{
    const Vec3 sum = rounded(newell_sum<double>(contour));
    return glm::length(sum) > certain * newell_size(contour) ? sum
                                                             : rounded(newell_sum<Quad>(contour));
}

/// placed_normal() for the cases in which double loses digits.
Vec3 exactly_placed_normal(const Polygon& polygon, const Mat3& linear)
{
    const auto own = newell_sum<Quad>(polygon.contours[0]);
    const Quad side = exact_determinant(linear) < 0 ? -1 : 1;
    Components<Quad> placed{};
    Quad largest = 0;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            placed.of[row] += side * exact_minor(linear, column, row) * own.of[column];
        largest = std::max(largest, magnitude(placed.of[row]));
    }
    for (Quad& component : placed.of)
        component /= largest;
    return glm::normalize(rounded(placed));
}

double size_of(const Polygon& polygon)
{
    double size = 0.0;
    for (const Contour& contour : polygon.contours)
        for (const Vec3& corner : contour)
            size = std::max(size, glm::length(corner - polygon.contours[0][0]));
    return size;
}

std::optional<std::string> fault_of_contours(const Polygon& polygon)
{
    if (polygon.contours.empty())
        return "the polygon has no vertices; give it three or more";
    for (const Contour& contour : polygon.contours) {
        if (contour.size() < 3)
            return "the polygon has a contour of " +
                   counted(static_cast<std::int64_t>(contour.size()), "vertex", "vertices") +
                   "; give it three or more";
        for (const Vec3& corner : contour)
            if (!std::isfinite(corner.x) || !std::isfinite(corner.y) || !std::isfinite(corner.z))
                return "a vertex of the polygon is not finite; give it three finite numbers";
    }
    return std::nullopt;
}

}  // namespace

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

    // The second axis must point to the side of its world axis.
    const int second = major == 2 ? 1 : 2;
    if (plane.v[second] < 0.0)
        plane.v = -plane.v;
}

Vec3 polygon_normal(const Polygon& polygon)
{
    if (polygon.contours.empty() || polygon.contours[0].empty())
        return Vec3(0.0);
    const Vec3 sum = newell_normal(polygon.contours[0]);
    const double largest = largest_component(sum);
    return largest > 0.0 ? glm::normalize(sum / largest) : Vec3(0.0);
}

Vec3 placed_normal(const Polygon& polygon, const Mat3& linear)
{
    const Vec3 own = polygon_normal(polygon);
    // The inverse transpose of `linear`, up to a factor.
    const Mat3 minors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                      glm::cross(linear[0], linear[1]));
    const Vec3 length(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
    const Vec3 terms(length.y * length.z, length.z * length.x, length.x * length.y);
    const Vec3 placed = minors * own;
    const double determinant = glm::dot(linear[0], minors[0]);
    if (glm::length(placed) > certain * glm::dot(terms, glm::abs(own)) &&
        std::abs(determinant) > certain * certain * length.x * terms.x)
        return glm::normalize(determinant < 0.0 ? -placed : placed);
    return exactly_placed_normal(polygon, linear);
}

std::optional<std::string> polygon_fault(const Polygon& polygon)
{
    if (const auto fault = fault_of_contours(polygon))
        return fault;
    const double size = size_of(polygon);
    if (!(glm::length(newell_normal(polygon.contours[0])) > least_area * size * size))
        return "the polygon's first contour encloses no area: its vertices are on one line, or it "
               "crosses itself into halves that cancel; move one, or begin with another contour";

    const Vec3 normal = polygon_normal(polygon);
    const Vec3& first = polygon.contours[0][0];
    int number = 0;
    int worst = 0;
    double off = 0.0;
    double coordinate = 0.0;
    for (const Contour& contour : polygon.contours)
        for (const Vec3& corner : contour) {
            ++number;
            coordinate = std::max(coordinate, largest_component(corner));
            if (const double here = std::abs(glm::dot(normal, corner - first)); here > off) {
                off = here;
                worst = number;
            }
        }
    const double allowed =
        flatness * size + 8.0 * std::numeric_limits<double>::epsilon() * coordinate;
    if (off > allowed)
        return "the polygon is not flat: vertex " + std::to_string(worst) + " is " + brief(off) +
               " off its plane, and " + brief(allowed) +
               " is allowed; move it, or split the polygon into flat ones";
    return std::nullopt;
}

}  // namespace packtrace
