#include "reference/light/glass.hpp"

#include "reference/light/refract.hpp"
#include "reference/surfaces/inside.hpp"

#include <algorithm>
#include <utility>

namespace packtrace::reference {

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
    // Straight on: in again where the ray already is, or out where it never was, as happens
    // with open surfaces and with a full stack.
    if (at.leaving != recorded || (!at.leaving && ray.inside.full()))
        return frac;
    if (at.leaving)
        frac.inside.remove(at.object);
    else
        frac.inside.push(at.object);
    // Leaving a body further down than the one the ray travels in changes no medium.
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

template struct Glass<float>;
template struct Glass<double>;
template struct Glass<long double>;

}  // namespace packtrace::reference
