#pragma once

#include "reference/surface_point.hpp"
#include "reference/world.hpp"

#include <optional>
#include <vector>

namespace packtrace::reference {

/// What light does on its way through each object.
template <class Real>
struct Glass {
    struct Body {
        Color<Real> transmittance;  ///< share of light passed on; all zero for opaque
        Real ior;
    };
    std::vector<Body> bodies;  ///< by object number

    /// The ray that goes on behind the surface at `at`, or nothing at total internal reflection.
    [[nodiscard]] std::optional<Ray<Real>> refraction_ray(const Ray<Real>& ray,
                                                          const SurfacePoint<Real>& at) const;

    /// What a ray from `camera` starts inside of. The bodies are stacked in the order in which
    /// they are left going `forward`, the first on top, which puts nested bodies in theirs.
    [[nodiscard]] GlassStack stack_at(const Bodies<Real>& surfaces, const Vec3<Real>& camera,
                                      const Vec3<Real>& forward) const;

private:
    [[nodiscard]] Real ior_in(const GlassStack& stack) const;
};

}  // namespace packtrace::reference
