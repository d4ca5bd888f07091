#pragma once

#include <packtrace/scene.hpp>
#include "reference/surfaces/surface_normal.hpp"
#include "reference/vec3.hpp"

#include <cmath>
#include <vector>

namespace packtrace::reference {

/// An object's colour: plain, or two colours in squares along a plane's axes.
template <class Real>
struct Paint {
    Color<Real> color;
    bool checkered = false;
    Color<Real> other;
    Real size = 1;
    Vec3<Real> point;
    Vec3<Real> u;
    Vec3<Real> v;
};

template <class Real>
[[nodiscard]] Paint<Real> make_paint(const Object& object);

/// The square of two colours that `own`, a point in the plane's own space, lies in.
template <class Real>
[[nodiscard]] Color<Real> checker_color(const Paint<Real>& paint, const Vec3<Real>& own)
{
    const Vec3<Real> from_corner = own - paint.point;
    const Real squares = std::floor(dot(from_corner, paint.u) / paint.size) +
                         std::floor(dot(from_corner, paint.v) / paint.size);
    const bool even = std::floor(squares / 2) * 2 == squares;
    return even ? paint.color : paint.other;
}

/// The colour of object number `object` at the world point `P`.
template <class Real>
[[nodiscard]] Color<Real> color_at(const Paint<Real>& paint, const Bodies<Real>& bodies, int object,
                                   const Vec3<Real>& P)
{
    return paint.checkered ? checker_color(paint, own_point(bodies, object, P)) : paint.color;
}

}  // namespace packtrace::reference
