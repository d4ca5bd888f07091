#pragma once

#include <packtrace/surface.hpp>
#include "reference/surfaces/affine.hpp"
#include "reference/surfaces/roots.hpp"
#include "reference/vec3.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace packtrace::reference {

/// A planar polygon; of each contour the first corner stands once more at its end.
template <class Real>
struct PolygonBody {
    std::vector<std::vector<Vec3<Real>>> contours;
    Vec3<Real> normal;
    int object = 0;
};

/// The polygon where `placement` puts it, in long double but for one rounding at the end, so that
/// polygons with a common corner share it to the last digit.
template <class Real>
[[nodiscard]] PolygonBody<Real> polygon_body(const Polygon& polygon,
                                             const Affine<long double>& placement, int object)
{
    PolygonBody<Real> body;
    for (const auto& from : polygon.contours) {
        auto& contour = body.contours.emplace_back();
        for (const packtrace::Vec3& corner : from)
            contour.emplace_back(placement.point_to_world(Vec3<long double>(corner)));
        contour.push_back(contour[0]);
    }
    body.normal = Vec3<Real>(
        normalize(placement.normal_to_world(Vec3<long double>(polygon_normal(polygon)))));
    body.object = object;
    return body;
}

/// The space of a line in which it is the third axis: points are sheared along their largest
/// component of its direction (Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", 2013).
/// A point's place there depends on nothing but the line and the point.
template <class Real>
class LineSpace {
public:
    LineSpace(const Vec3<Real>& O, const Vec3<Real>& D) : origin_(O)
    {
        const Real d[3] = {D.x, D.y, D.z};
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs(d[axis]) > std::abs(d[along_]))
                along_ = axis;
        slope_x_ = d[(along_ + 1) % 3] / d[along_];
        slope_y_ = d[(along_ + 2) % 3] / d[along_];
        length_ = d[along_];
    }

    /// x and y across the line, z the t of the point.
    [[nodiscard]] Vec3<Real> operator()(const Vec3<Real>& P) const
    {
        const Vec3<Real> off = P - origin_;
        const Real p[3] = {off.x, off.y, off.z};
        return {p[(along_ + 1) % 3] - slope_x_ * p[along_],
                p[(along_ + 2) % 3] - slope_y_ * p[along_], p[along_] / length_};
    }

private:
    Vec3<Real> origin_;
    int along_ = 0;
    Real slope_x_;
    Real slope_y_;
    Real length_;
};

/// Whether a b > c d, right to the last digit: where the products round to one number, what
/// rounding took of each decides.
template <class Real>
[[nodiscard]] bool product_above(Real a, Real b, Real c, Real d)
{
    const Real ab = a * b;
    const Real cd = c * d;
    return ab != cd ? ab > cd : std::fma(a, b, -ab) > std::fma(c, d, -cd);
}

/// Whether the edge between two points of a line's space crosses the positive x axis. An end on the
/// axis counts as below. The ends are taken lower one first, so that all polygons at an edge decide
/// alike whichever way they run along it.
template <class Real>
[[nodiscard]] bool crosses_positive_x(const Vec3<Real>& a, const Vec3<Real>& b)
{
    if ((a.y > 0) == (b.y > 0))
        return false;
    const auto& [lower, upper] = a.y > 0 ? std::tie(b, a) : std::tie(a, b);
    return product_above(lower.x, upper.y, upper.x, lower.y);
}

/// Below this share of a direction's length rounding may decide about its slope to a plane.
template <class Real>
inline constexpr Real edge_on = 1024 * std::numeric_limits<Real>::epsilon();

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const PolygonBody<Real>& polygon, const Vec3<Real>& O,
                                   const Vec3<Real>& D)
{
    const LineSpace<Real> space(O, D);
    bool inside = false;
    // Where the edges cross the x axis, seen along the line.
    Real nearest = std::numeric_limits<Real>::infinity();
    Real farthest = -nearest;
    for (const auto& contour : polygon.contours) {
        Vec3<Real> last = space(contour[0]);
        for (const Vec3<Real>& corner : contour) {
            const Vec3<Real> next = space(corner);
            if ((last.y > 0) != (next.y > 0)) {
                inside ^= crosses_positive_x(last, next);
                const Real z = last.z + (next.z - last.z) * (last.y / (last.y - next.y));
                nearest = std::min(nearest, z);
                farthest = std::max(farthest, z);
            }
            last = next;
        }
    }
    Roots<Real> roots;
    if (!inside)
        return roots;
    const Real slope = dot(polygon.normal, D);
    Real t = dot(polygon.normal, polygon.contours[0][0] - O) / slope;
    // Rounding may have a line along the plane pass through: it is between edges then.
    const Real length = std::abs(D.x) + std::abs(D.y) + std::abs(D.z);
    if (!(std::abs(slope) > edge_on<Real> * length))
        t = t > nearest ? std::min(t, farthest) : nearest;
    roots.add(t, Part::side, slope > 0);
    return roots;
}

template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const PolygonBody<Real>& polygon, const Vec3<Real>&, Part)
{
    return polygon.normal;
}

}  // namespace packtrace::reference
