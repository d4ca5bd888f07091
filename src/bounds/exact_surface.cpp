#include "bounds/exact_surface.hpp"

#include <algorithm>
#include <variant>

// lab/truth/wide_surface.cpp resembles this file and shares nothing with it on purpose: stress
// tests check these bounds against its truth, and an error in shared code would show in neither.
namespace packtrace::bounds {
namespace {

using reference::cross;
using reference::dot;

BallVec balls(const Vec3& v)
{
    return ball_vec(v.x, v.y, v.z);
}

void define(ExactSurface& surface, const Sphere& sphere)
{
    for (int axis = 0; axis < 3; ++axis)
        surface.square[axis] = ball_vec(axis == 0, axis == 1, axis == 2);
    surface.constant = -(Ball(sphere.radius) * Ball(sphere.radius));
    surface.center = sphere.center;
}

void define(ExactSurface& surface, const Plane& plane)
{
    surface.linear = balls(0.5 * plane.normal);
    surface.center = plane.point;
}

void define(ExactSurface& surface, const Polygon& polygon)
{
    surface.center = polygon.contours[0][0];
    const BallVec center = balls(surface.center);
    for (const auto& contour : polygon.contours)
        for (std::size_t i = 0; i < contour.size(); ++i)
            surface.edges.push_back(
                {balls(contour[i]) - center, balls(contour[(i + 1) % contour.size()]) - center});
    for (std::size_t i = 0; i < polygon.contours[0].size(); ++i)
        surface.linear = surface.linear + cross(surface.edges[i][0], surface.edges[i][1]);
}

/// The two planes of a x² - b y² = 0, along any two of the axes; nothing for other quadrics.
std::optional<std::array<BallVec, 2>> crossing_planes(const std::array<double, 10>& k)
{
    if (std::any_of(k.begin() + 3, k.end(), [](double x) { return x != 0.0; }))
        return {};
    for (std::size_t gone = 0; gone < 3; ++gone) {
        const std::size_t plus = (gone + (k[(gone + 1) % 3] > 0.0 ? 1 : 2)) % 3;
        const std::size_t minus = 3 - gone - plus;
        if (k[gone] != 0.0 || !(k[plus] > 0.0) || !(k[minus] < 0.0))
            continue;
        Ball first[3];
        first[plus] = square_root(Ball(k[plus]));
        first[minus] = square_root(Ball(-k[minus]));
        Ball second[3] = {first[0], first[1], first[2]};
        second[minus] = -second[minus];
        return {{BallVec(first[0], first[1], first[2]), BallVec(second[0], second[1], second[2])}};
    }
    return {};
}

void define(ExactSurface& surface, const Quadric& quadric)
{
    const std::array<double, 10>& k = quadric.coefficients;
    surface.square[0] = ball_vec(k[0], k[3] / 2, k[4] / 2);
    surface.square[1] = ball_vec(k[3] / 2, k[1], k[5] / 2);
    surface.square[2] = ball_vec(k[4] / 2, k[5] / 2, k[2]);
    surface.linear = ball_vec(k[6] / 2, k[7] / 2, k[8] / 2);
    surface.constant = Ball(k[9]);
    surface.z_range = quadric.z_range;
    surface.capped = quadric.capped && quadric.z_range;
    if (!quadric.z_range)
        surface.sheets = crossing_planes(k);
}

BallVec apply(const BallVec (&rows)[3], const BallVec& v)
{
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

void invert(const BallVec (&m)[3], BallVec (&inverse)[3])
{
    const BallVec columns[3] = {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
    const Ball determinant = dot(m[0], columns[0]);
    inverse[0] = BallVec(columns[0].x, columns[1].x, columns[2].x) / determinant;
    inverse[1] = BallVec(columns[0].y, columns[1].y, columns[2].y) / determinant;
    inverse[2] = BallVec(columns[0].z, columns[1].z, columns[2].z) / determinant;
}

}  // namespace

ExactSurface::ExactSurface(const Surface& from, const Mat4& m)
{
    std::visit([this](const auto& surface) { define(*this, surface); }, from);
    placed = m != Mat4(1.0);
    if (!placed)
        return;
    BallVec rows[3];
    for (int row = 0; row < 3; ++row)
        rows[row] = ball_vec(m[0][row], m[1][row], m[2][row]);
    offset = Vec3(m[3]);
    invert(rows, inverse);
}

BallVec ExactSurface::point_to_own(const Vec3& P) const
{
    const BallVec from_offset = balls(P) - balls(offset);
    return (placed ? apply(inverse, from_offset) : from_offset) - balls(center);
}

BallVec ExactSurface::direction_to_own(const BallVec& d) const
{
    return placed ? apply(inverse, d) : d;
}

BallVec ExactSurface::second_order(const BallVec& v) const
{
    return apply(square, v);
}

Ball ExactSurface::value(const BallVec& p) const
{
    return dot(second_order(p) + linear + linear, p) + constant;
}

BallVec ExactSurface::gradient(const BallVec& p) const
{
    return second_order(p) + linear;
}

}  // namespace packtrace::bounds
