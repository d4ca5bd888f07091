#pragma once

#include "reference/ray_weight.hpp"
#include "reference/recorder.hpp"
#include "reference/start.hpp"
#include "reference/surfaces/bodies.hpp"

#include <vector>

namespace packtrace::reference {

/// Note 004, the assignment's algorithms for generic objects under a matrix, method by method, with
/// the note's names. Comments mark the differences from the note; docs/reference.md gives the
/// reasons. As in the note, shading happens in the object's own space, whose lengths and angles are
/// those of world space only under similarities.
template <class Real, class Recorder = NoRecorder>
class Note004 {
public:
    /// The note's (k, t0), with the piece of a capped quadric that was hit.
    struct Tuple {
        int k;
        Real t0;
        Part part;
    };

    /// `world` must outlive this; `scene` must be lit by Illumination::shader.
    Note004(const Scene& scene, const World<Real>& world, Recorder record = {});

    /// The light along a ray from the camera at `e`; `d` need not be unit.
    /// `weight` is not used: the model has no secondary rays.
    [[nodiscard]] Color<Real> trace_ray(const Vec3<Real>& e, const Vec3<Real>& d,
                                        const RayWeight<Real>& weight = {}) const;

    /// Fills `list` with one tuple for each object that the ray hits, by increasing t0, at equal t0
    /// the lower object first. `d` is unit.
    void minimum_intersection(const Vec3<Real>& e, const Vec3<Real>& d,
                              std::vector<Tuple>& list) const;

    /// The colour that one light gives to the first object hit.
    [[nodiscard]] Color<Real> shader(const Tuple& intersection, const Vec3<Real>& d,
                                     const Vec3<Real>& e, const LightSource<Real>& light) const;

    /// Whether a light in direction `S` (unit) at `distance` from `I` is occluded, all three in the
    /// own space of `object`.
    [[nodiscard]] bool shadowed(const PlacedBody<Real>& object, const Vec3<Real>& I,
                                const Vec3<Real>& S, Real distance) const;

    /// The same by SelfHits::exact, for a point in world space: no point is moved by an epsilon,
    /// and `on` says which piece of surface P is on.
    [[nodiscard]] bool shadowed_exactly(const Departure<Real>& on, const Vec3<Real>& P,
                                        const Vec3<Real>& S, const LightSource<Real>& light,
                                        Real distance) const;

private:
    struct Material {
        Real r[4];
    };

    [[no_unique_address]] Recorder record_;
    const World<Real>& world_;
    std::vector<PlacedBody<Real>> object_list_;
    std::vector<PlacedBody<Real>> occluders_;  // those that cast shadows
    std::vector<Material> materials_;
};

}  // namespace packtrace::reference
