#pragma once

#include "reference/surfaces/roots.hpp"
#include "reference/vec3.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace packtrace::reference {

/// A quadric in axes that make it s.x x² + s.y y² + s.z z² + 2 linear z + constant = 0, where
/// p = (axes[0].q, axes[1].q, axes[2].q) with q = own - center. Only one of s.z and linear is
/// not 0.
template <class Real>
struct CanonicalQuadric {
    Vec3<Real> axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3<Real> center;
    Vec3<Real> square;
    Real linear{};
    Real constant{};
};

/// The canonical form of Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0, found in long
/// double: the axes are eigenvectors (Jacobi's method). Sums that cancel to the rounding error of
/// their double coefficients count as 0.
template <class Real>
[[nodiscard]] CanonicalQuadric<Real> canonical_quadric(const std::array<double, 10>& coefficients);

/// A quadric, clipped by own z and perhaps capped.
template <class Real>
struct QuadricBody {
    CanonicalQuadric<Real> form;
    Real low = -std::numeric_limits<Real>::infinity();
    Real high = std::numeric_limits<Real>::infinity();
    bool capped = false;
    int object = 0;

    [[nodiscard]] Vec3<Real> point_to_canonical(const Vec3<Real>& own) const
    {
        return vector_to_canonical(own - form.center);
    }
    [[nodiscard]] Vec3<Real> vector_to_canonical(const Vec3<Real>& own) const
    {
        return {dot(form.axes[0], own), dot(form.axes[1], own), dot(form.axes[2], own)};
    }
    /// Whether the quadric is two planes that cross.
    [[nodiscard]] bool crossing_planes() const
    {
        const Vec3<Real>& s = form.square;
        return form.constant == 0 && form.linear == 0 && (s.x == 0) + (s.y == 0) + (s.z == 0) == 1;
    }
    /// Half the gradient at a canonical point.
    [[nodiscard]] Vec3<Real> half_gradient(const Vec3<Real>& p) const
    {
        const Vec3<Real> bent = form.square * p;
        return {bent.x, bent.y, bent.z + form.linear};
    }
    /// The direction of the gradient on the surface, of any length. Of two crossing planes it is
    /// the normal of one of them, also next to their edge, because |s_i| x_i² = |s_j| x_j² on them.
    [[nodiscard]] Vec3<Real> way_out(const Vec3<Real>& p) const
    {
        if (crossing_planes()) {
            const auto component = [](Real s, Real x) {
                return x == 0 ? x : std::copysign(std::sqrt(std::abs(s)), s * x);
            };
            return {component(form.square.x, p.x), component(form.square.y, p.y),
                    component(form.square.z, p.z)};
        }
        return half_gradient(p);
    }
    /// The left side of the equation at a canonical point; negative inside.
    [[nodiscard]] Real value(const Vec3<Real>& p) const
    {
        return dot(form.square * p, p) + 2 * form.linear * p.z + form.constant;
    }
};

/// A quadric's left side along the line p + t v in canonical space: a t² + 2 b t + c.
template <class Real>
struct QuadricLine {
    Real a;
    Real b;
    bool parallel;  ///< a is 0 up to rounding error: there is at most one root
};

template <class Real>
[[nodiscard]] QuadricLine<Real> line_of(const QuadricBody<Real>& quadric, const Vec3<Real>& p,
                                        const Vec3<Real>& v)
{
    // The error of a by rounding v and by computing a.
    constexpr Real roundoffs = 4 * std::numeric_limits<Real>::epsilon();
    const Vec3<Real> terms = quadric.form.square * v * v;
    const Real a = terms.x + terms.y + terms.z;
    const Real size = std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z);
    return {a, dot(quadric.half_gradient(p), v), std::abs(a) <= roundoffs * size};
}

/// A sum, and the sum of its terms' magnitudes, which tells how much may cancel.
template <class Real>
struct Cancelling {
    Real sum = 0;
    Real size = 0;

    void add(Real term)
    {
        sum += term;
        size += std::abs(term);
    }
    void add(const Vec3<Real>& terms)
    {
        add(terms.x);
        add(terms.y);
        add(terms.z);
    }
};

/// b² - a c of a line through p, by its moment m = p x v: without the terms that cancel for far
/// origins. Of crossing planes one square remains.
template <class Real>
[[nodiscard]] Cancelling<Real> discriminant_by_moment(const QuadricBody<Real>& quadric,
                                                      const Vec3<Real>& p, const Vec3<Real>& v)
{
    const auto& [axes, center, s, linear, constant] = quadric.form;
    const Vec3<Real> m = cross(p, v);
    Cancelling<Real> result;
    const Vec3<Real> others(s.y * s.z, s.z * s.x, s.x * s.y);
    result.add(-constant * (s * v * v));
    result.add(-(others * m * m));
    result.add(2 * linear * s.y * v.y * m.x);
    result.add(-2 * linear * s.x * v.x * m.y);
    result.add(linear * linear * v.z * v.z);
    return result;
}

/// The same by a, b and c themselves, which are small where a line nearly lies on the surface.
template <class Real>
[[nodiscard]] Cancelling<Real> discriminant_by_terms(const QuadricBody<Real>& quadric,
                                                     const Vec3<Real>& p, const Vec3<Real>& v)
{
    const auto& [axes, center, s, linear, constant] = quadric.form;
    Cancelling<Real> a;
    Cancelling<Real> b;
    Cancelling<Real> c;
    a.add(s * v * v);
    b.add(s * p * v);
    c.add(s * p * p);
    b.add(linear * v.z);
    c.add(2 * linear * p.z);
    c.add(constant);
    return {b.sum * b.sum - a.sum * c.sum,
            2 * std::abs(b.sum) * b.size + std::abs(a.sum) * c.size + std::abs(c.sum) * a.size};
}

/// The discriminant by terms if much less cancels in it, else by the moment.
template <class Real>
[[nodiscard]] Real discriminant_of(const QuadricBody<Real>& quadric, const Vec3<Real>& p,
                                   const Vec3<Real>& v)
{
    const Cancelling<Real> by_moment = discriminant_by_moment(quadric, p, v);
    const Cancelling<Real> by_terms = discriminant_by_terms(quadric, p, v);
    return 4 * by_terms.size < by_moment.size ? by_terms.sum : by_moment.sum;
}

/// The t at which a line is nearest to the centre. Distances are weighted by the surface's
/// curvature: those along a cylinder or an edge count as 0, but not those along a paraboloid's
/// axis.
template <class Real>
[[nodiscard]] Real nearest_to_center(const QuadricBody<Real>& quadric, const Vec3<Real>& p,
                                     const Vec3<Real>& v)
{
    const Vec3<Real>& s = quadric.form.square;
    Vec3<Real> weight(std::abs(s.x), std::abs(s.y), std::abs(s.z));
    if (quadric.form.linear != 0)
        weight.z = std::max(weight.x, weight.y);
    const Real distance = dot(weight * v, v);
    return distance > 0 ? -dot(weight * p, v) / distance : Real(0);
}

/// Where a line in canonical space is inside the surface, without clipping.
template <class Real>
[[nodiscard]] Interior<Real> interior_along(const QuadricBody<Real>& quadric, const Vec3<Real>& org,
                                            const Vec3<Real>& v)
{
    // From the line's point nearest to the centre, so that a far origin costs no digits.
    const Real start = nearest_to_center(quadric, org, v);
    const Vec3<Real> p = org + start * v;
    const auto [a, b, parallel] = line_of(quadric, p, v);
    const Real c = quadric.value(p);
    Interior<Real> interior = parallel
                                  ? interior_of_line(b, c)
                                  : interior_of_parabola(a, b, c, discriminant_of(quadric, p, v));
    interior.first += start;
    interior.last += start;
    return interior;
}

/// The slab for a line at height `z` that climbs by `climb` per unit of t.
template <class Real>
[[nodiscard]] Slab<Real> slab_of(const QuadricBody<Real>& quadric, Real z, Real climb)
{
    constexpr Real infinite = std::numeric_limits<Real>::infinity();
    const auto& [form, low, high, capped, object] = quadric;
    if (climb == 0)
        return low <= z && z <= high ? Slab<Real>{} : Slab<Real>{infinite, -infinite};
    if (climb > 0)
        return {(low - z) / climb, (high - z) / climb, Part::low_cap, Part::high_cap, capped};
    return {(high - z) / climb, (low - z) / climb, Part::high_cap, Part::low_cap, capped};
}

template <class Real>
[[nodiscard]] Roots<Real> roots_of(const QuadricBody<Real>& quadric, const Vec3<Real>& org,
                                   const Vec3<Real>& dir)
{
    const Interior<Real> interior =
        interior_along(quadric, quadric.point_to_canonical(org), quadric.vector_to_canonical(dir));
    return clipped_roots(interior, slab_of(quadric, org.z, dir.z));
}

/// Outwards, not normalised.
template <class Real>
[[nodiscard]] Vec3<Real> normal_at(const QuadricBody<Real>& quadric, const Vec3<Real>& P, Part part)
{
    switch (part) {
        case Part::low_cap:
            return {0, 0, -1};
        case Part::high_cap:
            return {0, 0, 1};
        case Part::side:
            break;
    }
    const Vec3<Real> n = quadric.way_out(quadric.point_to_canonical(P));
    const auto& axes = quadric.form.axes;
    return n.x * axes[0] + n.y * axes[1] + n.z * axes[2];
}

/// A function that is 0 on the surface and has the gradient normal_at().
template <class Real>
[[nodiscard]] Real value_at(const QuadricBody<Real>& quadric, const Vec3<Real>& P, Part part)
{
    switch (part) {
        case Part::low_cap:
            return quadric.low - P.z;
        case Part::high_cap:
            return P.z - quadric.high;
        case Part::side:
            break;
    }
    const Vec3<Real> p = quadric.point_to_canonical(P);
    const Real half = quadric.value(p) / 2;
    return half != 0 && quadric.crossing_planes() ? dot(quadric.way_out(p), p) : half;
}

}  // namespace packtrace::reference
