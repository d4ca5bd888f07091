#pragma once

#include "reference/glass.hpp"
#include "reference/ray_weight.hpp"
#include "reference/recorder.hpp"
#include "reference/world.hpp"

#include <vector>

namespace packtrace::reference {

/// The common equation to which all models are lowered:
///     I(ray) = ka A + sum_j s_j I_j (kd max(0, N.L_j) + ks max(0, R_j.V)^n)
///              + kr I(reflected) + kt I(refracted)
/// over the lights j with N.L_j > 0.
template <class Real, class Recorder = NoRecorder>
class General {
public:
    struct Coefficients {
        Color<Real> ka;
        Color<Real> kd;
        Color<Real> ks;
        Color<Real> kr;
        Color<Real> kt;
        Real n;
    };

    /// `world` must outlive this; `scene` must be lit by Illumination::general.
    General(const Scene& scene, const World<Real>& world, Recorder record = {});

    /// The light along a ray from the eye at `org`; `dir` need not be unit.
    [[nodiscard]] Color<Real> trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                        const RayWeight<Real>& weight = {}) const;

private:
    [[nodiscard]] Color<Real> intensity(const Ray<Real>& ray, int depth,
                                        const RayWeight<Real>& weight) const;
    [[nodiscard]] Color<Real> child(const Ray<Real>& ray, int depth,
                                    const RayWeight<Real>& weight) const;
    [[nodiscard]] Color<Real> local(const Coefficients& k, const SurfacePoint<Real>& at,
                                    const Vec3<Real>& V) const;

    [[no_unique_address]] Recorder record_;
    const World<Real>& world_;
    std::vector<Coefficients> coefficients_;  // by object number
    Glass<Real> glass_;
    GlassStack around_eye_;
    Color<Real> at_limit_;  // the colour of a ray beyond the depth limit
};

}  // namespace packtrace::reference
