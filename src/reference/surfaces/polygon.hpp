#pragma once

#include "kernel_abi/even_odd.hpp"
#include "reference/surfaces/affine.hpp"
#include "reference/surfaces/roots.hpp"
#include "reference/vec3.hpp"
#include "scene/polygon_plane.hpp"
#include <packtrace/surface.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace packtrace::reference {

/// A planar polygon. Each contour ends with its first corner.
template <class Real>
struct PolygonBody {
    std::vector<std::vector<Vec3<Real>>> contours;
    Vec3<Real> normal;
    int object = 0;
};

/// The polygon under `transform`, computed in long double and rounded once, so that neighbours
/// share their corners exactly.
template <class Real>
[[nodiscard]] PolygonBody<Real> polygon_body(const Polygon& polygon, const Mat4& transform,
                                             int object)
{
    const Affine<long double> placement(transform);
    PolygonBody<Real> body;
    for (const auto& from : polygon.contours) {
        auto& contour = body.contours.emplace_back();
        for (const packtrace::Vec3& corner : from)
            contour.emplace_back(placement.point_to_world(Vec3<long double>(corner)));
        contour.push_back(contour[0]);
    }
    body.normal = Vec3<Real>(placed_normal(polygon, Mat3(transform)));
    body.object = object;
    return body;
}

/// Where a direction's slope to a plane is below this share of its length, rounding may decide.
template <class Real>
inline constexpr Real edge_on = 1024 * std::numeric_limits<Real>::epsilon();

template <class Real>
[[nodiscard]] bool passes_through(const PolygonBody<Real>& polygon, const Vec3<Real>& O,
                                  const Vec3<Real>& D)
{
    // Products of floats would underflow in float.
    using Exact = std::conditional_t<std::is_same_v<Real, float>, double, Real>;
    abi::EvenOdd<Exact> rule({O.x, O.y, O.z}, {D.x, D.y, D.z});
    for (const auto& contour : polygon.contours) {
        rule.start({contour[0].x, contour[0].y, contour[0].z});
        for (std::size_t i = 1; i < contour.size(); ++i)
            rule.edge_to({contour[i].x, contour[i].y, contour[i].z});
    }
    return rule.inside();
}

/// `t` clamped to the range of the edges that cross a half axis across the line, computed with
/// rounding; `t` itself where no edge is found.
template <class Real>
[[nodiscard]] Real between_edges(const PolygonBody<Real>& polygon, const Vec3<Real>& O,
                                 const Vec3<Real>& D, Real t)
{
    const Real d[3] = {D.x, D.y, D.z};
    int along = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(d[axis]) > std::abs(d[along]))
            along = axis;
    const int across = (along + 2) % 3;
    Real nearest = std::numeric_limits<Real>::infinity();
    Real farthest = -nearest;
    for (const auto& contour : polygon.contours) {
        Real last_height = 0;
        Real last_t = 0;
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec3<Real> off = contour[i] - O;
            const Real w[3] = {off.x, off.y, off.z};
            const Real at = w[along] / d[along];
            const Real height = w[across] - at * d[across];
            if (i > 0 && (height > 0) != (last_height > 0)) {
                const Real here = last_t + (at - last_t) * (last_height / (last_height - height));
                nearest = std::min(nearest, here);
                farthest = std::max(farthest, here);
            }
            last_height = height;
            last_t = at;
        }
    }
    if (!(nearest <= farthest))
        return t;
    return t > nearest ? std::min(t, farthest) : nearest;
}

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const PolygonBody<Real>& polygon, const Vec3<Real>& O,
                                   const Vec3<Real>& D)
{
    Roots<Real> roots;
    if (!passes_through(polygon, O, D))
        return roots;
    const Real slope = dot(polygon.normal, D);
    const Vec3<Real> to = polygon.contours[0][0] - O;
    Real t = dot(polygon.normal, to) / slope;
    // Rounding may put the hit of a line along the plane anywhere: it is clamped between the edges.
    // A start in the plane, where every term is 0, has no such error.
    const Real length = size_of(D);
    if (!(std::abs(slope) > edge_on<Real> * length)) {
        const Vec3<Real> terms = polygon.normal * to;
        if (terms.x != 0 || terms.y != 0 || terms.z != 0)
            t = between_edges(polygon, O, D, t);
    }
    roots.add({.t = t, .part = Part::side, .leaving = slope > 0});
    return roots;
}

template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const PolygonBody<Real>& polygon, const Vec3<Real>&, Part)
{
    return polygon.normal;
}

/// The position that the surface is defined relative to.
template <class Real>
[[nodiscard]] Vec3<Real> place_of(const PolygonBody<Real>& polygon)
{
    return polygon.contours[0][0];
}

/// A function that is 0 on the surface and has the gradient normal_at().
template <class Real>
[[nodiscard]] Real value_at(const PolygonBody<Real>& polygon, const Vec3<Real>& P, Part)
{
    return dot(polygon.normal, P - polygon.contours[0][0]);
}

}  // namespace packtrace::reference
