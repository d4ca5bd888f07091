#include "lab/truth/wide_truth.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <type_traits>
#include <variant>

// bounds/exact_surface.cpp resembles this file and shares nothing with it on purpose: the truth
// checks proven bounds in stress tests, and an error in shared code would show in neither.
namespace packtrace::lab {
namespace {

using reference::cross;
using reference::dot;

void set_coefficients(WideSurface& surface, const std::array<double, 10>& k)
{
    surface.square[0] = {Wide(k[0]), Wide(k[3]) / 2, Wide(k[4]) / 2};
    surface.square[1] = {Wide(k[3]) / 2, Wide(k[1]), Wide(k[5]) / 2};
    surface.square[2] = {Wide(k[4]) / 2, Wide(k[5]) / 2, Wide(k[2])};
    surface.linear = {Wide(k[6]) / 2, Wide(k[7]) / 2, Wide(k[8]) / 2};
    surface.constant = Wide(k[9]);
}

void define(WideSurface& surface, const Sphere& sphere)
{
    const WideVec center = wide(sphere.center);
    set_coefficients(surface, {1, 1, 1, 0, 0, 0, 0, 0, 0, 0});
    surface.linear = -center;
    surface.radius2 = Wide(sphere.radius) * sphere.radius;
    surface.place = magnitudes(center);
    surface.by_points = surface.placed;
}

void define(WideSurface& surface, const Plane& plane)
{
    set_coefficients(surface, {});
    surface.linear = wide(plane.normal) / Wide(2);
    surface.constant = -dot(wide(plane.normal), wide(plane.point));
    surface.place = magnitudes(wide(plane.point));
    surface.by_points = surface.placed;
}

void define(WideSurface& surface, const Polygon& polygon)
{
    set_coefficients(surface, {});
    const WideVec first = wide(polygon.contours[0][0]);
    for (const auto& contour : polygon.contours)
        for (std::size_t i = 0; i < contour.size(); ++i)
            surface.edges.push_back({wide(contour[i]), wide(contour[(i + 1) % contour.size()])});
    for (std::size_t i = 0; i < polygon.contours[0].size(); ++i) {
        const auto& [from, to] = surface.edges[i];
        surface.linear = surface.linear + cross(from - first, to - first);
    }
    surface.constant = -Wide(2) * dot(surface.linear, first);
    for (const auto& [from, to] : surface.edges) {
        const WideVec size = magnitudes(from);
        surface.place = {std::max(surface.place.x, size.x), std::max(surface.place.y, size.y),
                         std::max(surface.place.z, size.z)};
    }
    surface.by_points = surface.placed;
}

/// The two planes of a x² - b y² = 0, along any two of the axes; nothing for other quadrics.
std::optional<std::array<WideVec, 2>> crossing_planes(const std::array<double, 10>& k)
{
    if (std::any_of(k.begin() + 3, k.end(), [](double x) { return x != 0.0; }))
        return {};
    for (std::size_t gone = 0; gone < 3; ++gone) {
        const std::size_t plus = (gone + (k[(gone + 1) % 3] > 0.0 ? 1 : 2)) % 3;
        const std::size_t minus = 3 - gone - plus;
        if (k[gone] != 0.0 || !(k[plus] > 0.0) || !(k[minus] < 0.0))
            continue;
        Wide first[3] = {0, 0, 0};
        first[plus] = square_root(Wide(k[plus]));
        first[minus] = square_root(Wide(-k[minus]));
        Wide second[3] = {first[0], first[1], first[2]};
        second[minus] = -second[minus];
        return {{WideVec(first[0], first[1], first[2]), WideVec(second[0], second[1], second[2])}};
    }
    return {};
}

void define(WideSurface& surface, const Quadric& quadric)
{
    set_coefficients(surface, quadric.coefficients);
    if (quadric.kind == QuadricKind::general)
        surface.canonical = canonical_form(quadric.coefficients);
    if (!quadric.z_range)
        surface.sheets = crossing_planes(quadric.coefficients);
    surface.z_range = quadric.z_range;
    surface.capped = quadric.capped;
}

WideVec apply(const WideVec (&rows)[3], const WideVec& v)
{
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

void invert(const WideVec (&m)[3], WideVec (&inverse)[3])
{
    const WideVec columns[3] = {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
    const Wide determinant = dot(m[0], columns[0]);
    inverse[0] = WideVec(columns[0].x, columns[1].x, columns[2].x) / determinant;
    inverse[1] = WideVec(columns[0].y, columns[1].y, columns[2].y) / determinant;
    inverse[2] = WideVec(columns[0].z, columns[1].z, columns[2].z) / determinant;
}

/// Takes the magnitudes of the surface's place to the world, and adds those of the offset.
void carry_place(WideSurface& surface)
{
    WideVec rows[3];
    for (int row = 0; row < 3; ++row)
        rows[row] = magnitudes(surface.world[row]);
    surface.place = apply(rows, surface.place) + magnitudes(surface.offset);
}

}  // namespace

WideSurface::WideSurface(const Object& from, std::int32_t number) : object(number)
{
    const Mat4& m = from.transform;
    placed = m != Mat4(1.0);
    for (int row = 0; row < 3; ++row)
        world[row] = {Wide(m[0][row]), Wide(m[1][row]), Wide(m[2][row])};
    offset = {Wide(m[3][0]), Wide(m[3][1]), Wide(m[3][2])};
    invert(world, own);
    std::visit([this](const auto& surface) { define(*this, surface); }, from.surface);
    if (placed)
        carry_place(*this);
}

WideVec WideSurface::point_to_own(const WideVec& P) const
{
    return placed ? apply(own, P - offset) : P;
}

WideVec WideSurface::direction_to_own(const WideVec& d) const
{
    return placed ? apply(own, d) : d;
}

WideVec WideSurface::second_order(const WideVec& v) const
{
    return apply(square, v);
}

Wide WideSurface::value(const WideVec& p) const
{
    if (radius2) {
        const WideVec from_center = gradient(p);
        return dot(from_center, from_center) - *radius2;
    }
    return dot(second_order(p) + linear + linear, p) + constant;
}

WideVec WideSurface::gradient(const WideVec& p) const
{
    return second_order(p) + linear;
}

WideVec WideSurface::covector_to_world(const WideVec& n) const
{
    return placed ? n.x * own[0] + n.y * own[1] + n.z * own[2] : n;
}

}  // namespace packtrace::lab
