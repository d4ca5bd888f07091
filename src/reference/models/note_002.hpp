#pragma once

#include "reference/glass.hpp"
#include "reference/ray_weight.hpp"
#include "reference/recorder.hpp"
#include "reference/world.hpp"

#include <vector>

namespace packtrace::reference {

/// Note 002, Whitted's "An Improved Illumination Model for Shaded Display" (1980) as its author
/// modified it: I = Ia + kd sum(N.Lj) + ks R + kt T with the highlight (Rj.V)^ns, and light
/// through a transparent occluder. With the note's names; docs/reference.md lists the differences.
template <class Real, class Recorder = NoRecorder>
class Note002 {
public:
    struct Constants {
        Color<Real> Ia;  ///< ambient, times the object's colour
        Color<Real> kd;  ///< diffuse, times the object's colour
        Color<Real> ks;  ///< mirror and highlight, white
        Color<Real> kt;  ///< transmission, white
        Real ns;
    };

    /// `world` must outlive this; `scene` must be lit by Illumination::whitted.
    Note002(const Scene& scene, const World<Real>& world, Recorder record = {});

    /// The light along a ray from the eye at `org`; `dir` need not be unit.
    [[nodiscard]] Color<Real> trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                        const RayWeight<Real>& weight = {}) const;

private:
    [[nodiscard]] Color<Real> intensity(const Ray<Real>& ray, int depth,
                                        const RayWeight<Real>& weight) const;
    [[nodiscard]] Color<Real> child(const Ray<Real>& ray, int depth,
                                    const RayWeight<Real>& weight) const;
    [[nodiscard]] Color<Real> lights(const Constants& k, const Color<Real>& color,
                                     const SurfacePoint<Real>& at, const Vec3<Real>& V) const;

    [[no_unique_address]] Recorder record_;
    const World<Real>& world_;
    std::vector<Constants> constants_;  // by object number
    Glass<Real> glass_;
    GlassStack around_eye_;
};

}  // namespace packtrace::reference
