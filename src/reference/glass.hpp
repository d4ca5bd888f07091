#pragma once

#include "reference/ray.hpp"
#include "reference/surfaces/inside.hpp"
#include "reference/world.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

// Refraction, and the glass bodies around a ray.
namespace packtrace::reference {

/// The refracted direction by Snell's law n1 sin(i) = n2 sin(r), for unit `D` and unit `N` turned
/// against it. It is unit to rounding; none at total internal reflection.
template <class Real>
[[nodiscard]] std::optional<Vec3<Real>> refract(const Vec3<Real>& D, const Vec3<Real>& N, Real n1,
                                                Real n2)
{
    const Real eta = n1 / n2;
    const Real cos_i = -dot(N, D);
    // 1 - eta² (1 - cos²), in which a small cosine keeps its digits.
    const Real cos_r_squared = (1 - eta) * (1 + eta) + (eta * cos_i) * (eta * cos_i);
    if (cos_r_squared < 0)
        return std::nullopt;
    return eta * D + (eta * cos_i - std::sqrt(cos_r_squared)) * N;
}

/// How each object lets light through.
template <class Real>
struct Glass {
    struct Body {
        Color<Real> transmittance;  ///< share of light passed on; all zero for opaque
        Real ior;
    };
    std::vector<Body> bodies;  ///< by object number

    /// The ray that goes on behind the surface at `at`; none at total internal reflection.
    [[nodiscard]] std::optional<Ray<Real>> refraction_ray(const Ray<Real>& ray,
                                                          const SurfacePoint<Real>& at) const;

    /// The initial medium stack of rays from `camera`. A ray along `forward` leaves the bodies from
    /// top to bottom, so that nested bodies are in their right order.
    [[nodiscard]] GlassStack stack_at(const Bodies<Real>& surfaces, const Vec3<Real>& camera,
                                      const Vec3<Real>& forward) const;

private:
    [[nodiscard]] Real ior_in(const GlassStack& stack) const;
};

template <class Real>
Real Glass<Real>::ior_in(const GlassStack& stack) const
{
    return stack.top() == GlassStack::outside ? Real(1)
                                              : bodies[static_cast<std::size_t>(stack.top())].ior;
}

template <class Real>
std::optional<Ray<Real>> Glass<Real>::refraction_ray(const Ray<Real>& ray,
                                                     const SurfacePoint<Real>& at) const
{
    Ray<Real> frac{at.P, ray.dir, ray.inside, at.through()};
    const bool recorded = ray.inside.contains(at.object);
    // Straight on: the ray enters a body that it is inside of already, or leaves one that it never
    // entered, as happens with open surfaces and with a full stack.
    if (at.leaving != recorded || (!at.leaving && ray.inside.full()))
        return frac;
    if (at.leaving)
        frac.inside.remove(at.object);
    else
        frac.inside.push(at.object);
    // Leaving a body below the top of the stack does not change the medium.
    if (at.leaving && ray.inside.top() != at.object)
        return frac;
    const auto dir = refract(ray.dir, at.N, ior_in(ray.inside), ior_in(frac.inside));
    if (!dir)
        return std::nullopt;
    frac.dir = *dir;
    return frac;
}

template <class Real>
GlassStack Glass<Real>::stack_at(const Bodies<Real>& surfaces, const Vec3<Real>& camera,
                                 const Vec3<Real>& forward) const
{
    std::vector<std::pair<Real, int>> left_at;
    visit_bodies(surfaces, [&](const auto& body) {
        const auto object = static_cast<std::size_t>(body.object);
        if (!any_positive(bodies[object].transmittance) || !is_inside(body, camera))
            return true;
        left_at.emplace_back(leaves_at(body, camera, forward), body.object);
        return true;
    });
    std::sort(left_at.rbegin(), left_at.rend());
    GlassStack stack;
    for (const auto& [t, object] : left_at)
        if (!stack.full())
            stack.push(object);
    return stack;
}

}  // namespace packtrace::reference
