#pragma once

#include "reference/surfaces/bodies.hpp"

#include <vector>

namespace packtrace::reference {

/// One meeting of a ray with a surface.
template <class Real>
struct SurfaceHit {
    Real t;
    int object;
    Vec3<Real> normal;  ///< unit, the surface's outward one, not turned to the ray
    bool leaving;       ///< the ray comes from the inside
};

/// Every meeting with t in [t_min, t_max], by increasing t, then object number. A ray that
/// touches a surface without crossing meets it twice at the same t.
template <class Real>
[[nodiscard]] std::vector<SurfaceHit<Real>> all_hits(const Bodies<Real>& bodies,
                                                     const Vec3<Real>& org, const Vec3<Real>& dir,
                                                     Real t_min, Real t_max);

}  // namespace packtrace::reference
