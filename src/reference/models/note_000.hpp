#pragma once

#include "reference/glass.hpp"
#include "reference/ray_weight.hpp"
#include "reference/recorder.hpp"
#include "reference/world.hpp"

#include <vector>

namespace packtrace::reference {

/// Note 000, the Pascal sketch of a recursive `intensity`, with the note's names. Comments mark the
/// differences from the note; docs/reference.md gives the reasons.
template <class Real, class Recorder = NoRecorder>
class Note000 {
public:
    /// The note's arrays Ka … S at one object.
    struct Factors {
        Color<Real> Ka;  ///< ambient, times the object's colour
        Color<Real> Kd;  ///< diffuse, times the object's colour
        Color<Real> Ks;  ///< mirror and highlight, white
        Color<Real> Kr;  ///< refraction, white
        Real S;
    };

    /// `world` must outlive this; `scene` must be lit by Illumination::sketch.
    Note000(const Scene& scene, const World<Real>& world, Recorder record = {});

    /// The light along a ray from the eye at `org`; `dir` need not be unit.
    [[nodiscard]] Color<Real> trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                        const RayWeight<Real>& weight = {}) const;

private:
    [[nodiscard]] Color<Real> intensity(const Ray<Real>& r, int depth,
                                        const RayWeight<Real>& weight) const;
    [[nodiscard]] Color<Real> child(const Ray<Real>& ray, int depth,
                                    const RayWeight<Real>& weight) const;
    [[nodiscard]] Color<Real> escaped(const Ray<Real>& r) const;
    [[nodiscard]] Color<Real> dull(const Factors& k, const Color<Real>& color,
                                   const SurfacePoint<Real>& at, const Ray<Real>& flec) const;

    [[no_unique_address]] Recorder record_;
    const World<Real>& world_;
    std::vector<Factors> factors_;  // by object number
    Glass<Real> glass_;
    GlassStack around_eye_;
    int deepest_;  // the note's 5
};

}  // namespace packtrace::reference
