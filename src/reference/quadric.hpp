#pragma once

#include "reference/roots.hpp"
#include "reference/vec3.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace packtrace::reference {

/// Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0 in its own space.
template <class Real>
struct QuadricBody {
    std::array<Real, 10> k{};  ///< A … J
    Real low = -std::numeric_limits<Real>::infinity();
    Real high = std::numeric_limits<Real>::infinity();
    bool capped = false;
    int object = 0;

    /// The left side of the equation at `p`; negative inside.
    [[nodiscard]] Real value(const Vec3<Real>& p) const
    {
        const auto& [A, B, C, D, E, F, G, H, I, J] = k;
        return p.x * (A * p.x + D * p.y + E * p.z + G) + p.y * (B * p.y + F * p.z + H) +
               p.z * (C * p.z + I) + J;
    }
    [[nodiscard]] Vec3<Real> gradient(const Vec3<Real>& p) const
    {
        const auto& [A, B, C, D, E, F, G, H, I, J] = k;
        return {2 * A * p.x + D * p.y + E * p.z + G, 2 * B * p.y + D * p.x + F * p.z + H,
                2 * C * p.z + E * p.x + F * p.y + I};
    }
    /// The second-order terms alone.
    [[nodiscard]] Real quadratic(const Vec3<Real>& d) const
    {
        const auto& [A, B, C, D, E, F, G, H, I, J] = k;
        return d.x * (A * d.x + D * d.y + E * d.z) + d.y * (B * d.y + F * d.z) + d.z * C * d.z;
    }
};

/// Adds the roots of the unclipped surface that lie within the z range.
template <class Real>
void add_side_roots(const QuadricBody<Real>& quadric, const Vec3<Real>& org, const Vec3<Real>& dir,
                    Roots<Real>& roots)
{
    // From the line's point nearest to the own origin, so that a far origin costs no digits.
    const Real t_near = -dot(org, dir) / dot(dir, dir);
    const Vec3<Real> p = org + t_near * dir;
    const Real a = quadric.quadratic(dir);
    const Real b = dot(quadric.gradient(p), dir) / 2;
    const Real c = quadric.value(p);
    const Real discriminant = b * b - a * c;
    if (!(discriminant >= 0))
        return;
    // The sum without cancellation; a = 0 (along an axis or asymptote) leaves c / q.
    const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
    for (const Real t : {q / a, c / q}) {
        const Real z = p.z + t * dir.z;
        if (quadric.low <= z && z <= quadric.high)
            roots.add(t_near + t);
    }
}

/// Adds the meeting with the flat piece of inside at height `z`, if there is one.
template <class Real>
void add_cap_root(const QuadricBody<Real>& quadric, const Vec3<Real>& org, const Vec3<Real>& dir,
                  Part part, Roots<Real>& roots)
{
    const Real z = part == Part::low_cap ? quadric.low : quadric.high;
    const Real t = (z - org.z) / dir.z;
    const Vec3<Real> p = org + t * dir;
    if (quadric.value({p.x, p.y, z}) <= 0)
        roots.add(t, part);
}

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const QuadricBody<Real>& quadric, const Vec3<Real>& org,
                                   const Vec3<Real>& dir)
{
    Roots<Real> roots;
    add_side_roots(quadric, org, dir, roots);
    if (quadric.capped) {
        add_cap_root(quadric, org, dir, Part::low_cap, roots);
        add_cap_root(quadric, org, dir, Part::high_cap, roots);
    }
    return roots;
}

/// The way out of the inside, not normalised.
template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const QuadricBody<Real>& quadric, const Vec3<Real>& p, Part part)
{
    switch (part) {
        case Part::low_cap:
            return {0, 0, -1};
        case Part::high_cap:
            return {0, 0, 1};
        case Part::side:
            break;
    }
    return quadric.gradient(p);
}

}  // namespace packtrace::reference
