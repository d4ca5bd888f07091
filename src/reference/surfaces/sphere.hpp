#pragma once

#include "reference/surfaces/roots.hpp"
#include "reference/vec3.hpp"

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace packtrace::reference {

template <class Real>
struct SphereBody {
    Vec3<Real> center;
    Real radius{};
    int object = 0;
    bool textbook = false;  ///< solved by note 001's own formula
};

/// Both roots by note 001's own quadratic formula; infinite for a line that misses.
template <class Real>
[[nodiscard]] std::pair<Real, Real> intersect_ray_sphere(const Vec3<Real>& O, const Vec3<Real>& D,
                                                         const SphereBody<Real>& sphere)
{
    const Real r = sphere.radius;
    const Vec3<Real> CO = O - sphere.center;
    const Real a = dot(D, D);
    const Real b = 2 * dot(CO, D);
    const Real c = dot(CO, CO) - r * r;
    const Real discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0))
        return {std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity()};
    const Real root = std::sqrt(discriminant);
    return {(-b + root) / (2 * a), (-b - root) / (2 * a)};
}

/// The precision that a sphere's equation is solved in: long double for double, because a ground
/// sphere's large radius would cost digits.
template <class Real>
using Solving = std::conditional_t<std::is_same_v<Real, double>, long double, Real>;

/// Whether a line misses the sphere by so much that rounding cannot matter.
template <class Real>
[[nodiscard]] bool passes_by(const SphereBody<Real>& sphere, const Vec3<Real>& O,
                             const Vec3<Real>& D)
{
    constexpr Real roundoff = 16 * std::numeric_limits<Real>::epsilon();
    const Vec3<Real> CO = O - sphere.center;
    const Vec3<Real> moment = cross(CO, D);
    const Real radius2 = sphere.radius * sphere.radius + roundoff * roundoff * dot(CO, CO);
    return dot(moment, moment) > 2 * dot(D, D) * radius2;
}

/// Where a line is inside a sphere. The discriminant is Lagrange's form a r² - |CO x D|², which
/// keeps its digits for far spheres.
template <class Real>
[[nodiscard]] Interior<Real> interior_along(const SphereBody<Real>& sphere, const Vec3<Real>& O,
                                            const Vec3<Real>& D)
{
    if (sphere.textbook) {
        const auto [t1, t2] = intersect_ray_sphere(O, D, sphere);
        return {t2, t1, true};
    }
    if (passes_by(sphere, O, D))
        return no_interior<Real>();
    using Wide = Solving<Real>;
    const Vec3<Wide> d(D);
    const Vec3<Wide> CO = Vec3<Wide>(O) - Vec3<Wide>(sphere.center);
    const Vec3<Wide> moment = cross(CO, d);
    const Wide r2 = Wide(sphere.radius) * sphere.radius;
    const Wide a = dot(d, d);
    const auto [first, last, between] =
        interior_of_parabola(a, dot(CO, d), dot(CO, CO) - r2, a * r2 - dot(moment, moment));
    return {static_cast<Real>(first), static_cast<Real>(last), between};
}

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const SphereBody<Real>& sphere, const Vec3<Real>& O,
                                   const Vec3<Real>& D)
{
    const Interior<Real> interior = interior_along(sphere, O, D);
    Roots<Real> roots;
    roots.add({.t = interior.first, .part = Part::side, .leaving = false});
    roots.add({.t = interior.last, .part = Part::side, .leaving = true});
    return roots;
}

/// Outwards, not normalised.
template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const SphereBody<Real>& sphere, const Vec3<Real>& P, Part)
{
    return P - sphere.center;
}

/// The position that the surface is defined relative to.
template <class Real>
[[nodiscard]] Vec3<Real> place_of(const SphereBody<Real>& sphere)
{
    return sphere.center;
}

/// A function that is 0 on the surface and has the gradient normal_at().
template <class Real>
[[nodiscard]] Real value_at(const SphereBody<Real>& sphere, const Vec3<Real>& P, Part)
{
    const Vec3<Real> w = P - sphere.center;
    return (dot(w, w) - sphere.radius * sphere.radius) / 2;
}

}  // namespace packtrace::reference
