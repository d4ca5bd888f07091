#pragma once

#include "reference/interior.hpp"
#include "reference/vec3.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace packtrace::reference {

template <class Real>
struct SphereBody {
    Vec3<Real> center;
    Real radius{};
    int object = 0;
    bool textbook = false;  ///< met by note 001's own formula
};

/// The textbook quadratic of note 001's book, both roots; infinite for a line that misses.
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

/// Where a line is inside a sphere. The discriminant is Lagrange's form a r² - |CO x D|², which
/// keeps its digits where the sphere is far away.
template <class Real>
[[nodiscard]] Interior<Real> interior_along(const SphereBody<Real>& sphere, const Vec3<Real>& O,
                                            const Vec3<Real>& D)
{
    if (sphere.textbook) {
        const auto [t1, t2] = intersect_ray_sphere(O, D, sphere);
        return {t2, t1, true};
    }
    const Real r = sphere.radius;
    const Vec3<Real> CO = O - sphere.center;
    const Vec3<Real> moment = cross(CO, D);
    const Real a = dot(D, D);
    const Real discriminant = a * (r * r) - dot(moment, moment);
    return interior_of_parabola(a, dot(CO, D), dot(CO, CO) - r * r, discriminant);
}

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const SphereBody<Real>& sphere, const Vec3<Real>& O,
                                   const Vec3<Real>& D)
{
    const Interior<Real> interior = interior_along(sphere, O, D);
    Roots<Real> roots;
    roots.add(interior.first, Part::side, false);
    roots.add(interior.last, Part::side, true);
    return roots;
}

/// Outwards, not normalised.
template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const SphereBody<Real>& sphere, const Vec3<Real>& P, Part)
{
    return P - sphere.center;
}

}  // namespace packtrace::reference
