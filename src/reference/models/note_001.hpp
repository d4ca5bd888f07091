#pragma once

#include "reference/ray.hpp"
#include "reference/ray_weight.hpp"
#include "reference/recorder.hpp"

#include <vector>

namespace packtrace::reference {

/// Note 001, the complete pseudocode of the raytracing chapters of "Computer Graphics from Scratch"
/// (Gambetta), function by function, with the note's names. Comments mark the differences from the
/// note; docs/reference.md gives the reasons.
template <class Real, class Recorder = NoRecorder>
class Note001 {
public:
    /// The shading keys of an object; its colour is in World::paints.
    struct Shading {
        Real specular;  ///< exponent; -1 for no highlight
        Real reflective;
    };

    /// `world` must outlive this; `scene` must be lit by Illumination::scratch.
    Note001(const Scene& scene, const World<Real>& world, Recorder record = {});

    /// The colour along a camera ray, from the projection plane on.
    [[nodiscard]] Color<Real> trace_ray(const Vec3<Real>& O, const Vec3<Real>& D,
                                        const RayWeight<Real>& weight = {}) const;

    [[nodiscard]] Color<Real> trace_ray(const Vec3<Real>& O, const Vec3<Real>& D, Real t_min,
                                        Real t_max, int depth,
                                        const RayWeight<Real>& weight = {}) const;

    /// The same from a start by the scene's rule for self-hits.
    [[nodiscard]] Color<Real> trace_ray(const Start<Real>& start, const Vec3<Real>& D, Real t_max,
                                        int depth, const RayWeight<Real>& weight) const;

    /// The light that reaches `P`, per channel. `V` points to where the ray came from. `on` is the
    /// surface that P is on; only SelfHits::exact uses it.
    [[nodiscard]] Color<Real> compute_lighting(const Vec3<Real>& P, const Vec3<Real>& N,
                                               const Vec3<Real>& V, Real s,
                                               const Departure<Real>& on = {}) const;

private:
    [[nodiscard]] bool in_shadow(const Departure<Real>& on, const Vec3<Real>& P,
                                 const Vec3<Real>& L, const LightSource<Real>& light,
                                 Real t_max) const;
    [[nodiscard]] const Vec3<Real>& normal(const SurfacePoint<Real>& at) const;

    [[no_unique_address]] Recorder record_;
    const World<Real>& world_;
    std::vector<Shading> shadings_;           // by object number
    std::vector<unsigned char> is_a_sphere_;  // by object number
};

}  // namespace packtrace::reference
