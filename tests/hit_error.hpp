#pragma once

#include "closest_hits.hpp"

#include <limits>

// Compares closest hits of the kernels with hits in long double.
namespace packtrace::test {

/// The exact hit of a ray with every object. The inputs are those that decide in the kernels: in
/// exact mode the scene's own numbers, else these numbers rounded to Real.
template <class Real>
[[nodiscard]] std::vector<ExactHit> exact_hits(const LongRay& ray, const LoweredScene& scene)
{
    const bool exact = scene.features.exact;
    const auto given = [=](const Vec3& v) {
        return exact ? LongVec(v) : LongVec(glm::vec<3, Real>(v));
    };
    std::vector<ExactHit> hits(scene.material_index.size());
    for (const LoweredSphere& sphere : scene.spheres) {
        const auto radius = static_cast<long double>(sphere.radius);
        const long double radius2 =
            exact ? radius * radius : static_cast<Real>(sphere.radius * sphere.radius);
        hits[static_cast<std::size_t>(sphere.surface)] =
            exact_sphere(ray, given(sphere.center), radius2, LongVec(sphere.center));
    }
    // An anchored sphere is given by a point of its surface, and its centre is not rounded to
    // float: the comparison uses the scene's own numbers. For doubles the scene's numbers are
    // rounded too.
    for (const LoweredAnchoredSphere& sphere : scene.anchored_spheres) {
        const long double radius2 = static_cast<long double>(sphere.radius) * sphere.radius;
        const LongVec place(sizeof(Real) < sizeof(double) ? sphere.anchor : sphere.center);
        hits[static_cast<std::size_t>(sphere.surface)] =
            exact_sphere(ray, LongVec(sphere.center), radius2, place);
    }
    for (const LoweredPlane& plane : scene.planes)
        hits[static_cast<std::size_t>(plane.surface)] =
            exact_plane(ray, given(plane.point), given(plane.normal));
    return hits;
}

/// Counts of wrong rays by kind of error. `band` and `worst_t` are in unit roundoffs of the
/// precision that decides: of double in exact mode, else of Real.
struct HitErrors {
    int rays = 0;
    int hits = 0;
    int undecidable = 0;  ///< rays with an object within `band` of the border between hit and miss
    int wrong_object = 0;
    double worst_t = 0.0;    ///< t's relative error over the error that the condition allows
    double worst_ulp = 0.0;  ///< t's error in units of Real's last place
};

/// If relative changes of the inputs by so many roundoffs turn a hit into a miss or back, either
/// answer is accepted.
inline constexpr long double band = 4.0L;

/// The bound of t's error, as a multiple of the error that rounded inputs cause; 2.5 was measured.
inline constexpr long double stability = 4.0L;

template <class Real>
class HitJudge {
public:
    explicit HitJudge(const LoweredScene& scene)
        : scene_(scene), roundoff_(scene.features.exact ? 0x1p-53L : own_roundoff)
    {
    }

    void judge(const TracedRay<Real>& traced)
    {
        const std::vector<ExactHit> exact = exact_hits<Real>(traced.ray, scene_);
        errors.rays += 1;
        errors.hits += traced.object >= 0;
        errors.undecidable += std::any_of(exact.begin(), exact.end(),
                                          [&](const ExactHit& hit) { return undecidable(hit); });
        errors.wrong_object += !is_closest(traced, exact);
        if (traced.object >= 0)
            judge_t(traced.t, exact[static_cast<std::size_t>(traced.object)]);
    }

    HitErrors errors;

private:
    static constexpr long double own_roundoff = std::numeric_limits<Real>::epsilon() / 2;

    [[nodiscard]] bool undecidable(const ExactHit& hit) const
    {
        return !(hit.margin >= band * roundoff_);
    }
    [[nodiscard]] long double allowed(const ExactHit& hit) const
    {
        return stability * hit.condition * roundoff_ * hit.t;
    }

    /// The object found is hit, and no other object is certainly nearer; for a miss, all objects
    /// are missed.
    [[nodiscard]] bool is_closest(const TracedRay<Real>& traced,
                                  const std::vector<ExactHit>& exact) const
    {
        const auto found = static_cast<std::size_t>(traced.object);
        if (traced.object >= 0 && !exact[found].hit && !undecidable(exact[found]))
            return false;
        // In exact mode the deciding precision is higher than the precision of the returned t.
        const bool known = scene_.features.exact && traced.object >= 0 && exact[found].hit;
        const long double t = known ? exact[found].t : static_cast<long double>(traced.t);
        for (std::size_t other = 0; other < exact.size(); ++other) {
            const ExactHit& hit = exact[other];
            if (other == found || !hit.hit || undecidable(hit))
                continue;
            if (traced.object < 0 || hit.t + allowed(hit) < t)
                return false;
        }
        return true;
    }

    void judge_t(Real t, const ExactHit& exact)
    {
        if (!exact.hit || undecidable(exact))
            return;
        const long double error = std::abs(static_cast<long double>(t) - exact.t);
        const long double ulp = std::ldexp(2 * own_roundoff, std::ilogb(exact.t));
        errors.worst_t = std::max(
            errors.worst_t, static_cast<double>(error / (exact.condition * roundoff_ * exact.t)));
        errors.worst_ulp = std::max(errors.worst_ulp, static_cast<double>(error / ulp));
    }

    const LoweredScene& scene_;
    long double roundoff_;
};

template <class Real>
[[nodiscard]] HitErrors hit_errors(const abi::KernelTable& table, const Scene& scene,
                                   Accuracy accuracy = Accuracy::exact)
{
    const TracingSetup<Real> setup(scene, accuracy);
    HitJudge<Real> judge(setup.lowered);
    for (const TracedRay<Real>& traced : trace_closest(table, setup, scene))
        judge.judge(traced);
    return judge.errors;
}

}  // namespace packtrace::test
