#pragma once

#include "lab/stress/stress.hpp"
#include "lab/stress/stress_family.hpp"
#include "lab/truth/wide_truth.hpp"
#include "render/ray_columns.hpp"
#include <packtrace/intersect.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

// Groups of rays with their truth, the kernels under test, and the queries of each group.
namespace packtrace::lab {

/// The unit roundoff: half the distance from 1 to the next number.
template <class Real>
inline constexpr double roundoff_of = double{std::numeric_limits<Real>::epsilon()} / 2.0;

// stress_group.cpp

/// A sphere for a quick test in double, which passes all lines that come near the sphere.
struct SphereScreen {
    Vec3 center{0.0};
    double radius = -1.0;  ///< negative for a placed sphere or another surface: it always passes
    double slack = 0.0;    ///< added to the radius
};

/// Rays of one scene with their truth.
struct StressGroup {
    Scene scene;
    std::vector<WideSurface> surfaces;
    std::vector<SphereScreen> screens;
    std::vector<StressRay> rays;
    std::vector<Expected> expected;  ///< by ray

    /// All hits of a ray, and all places that it nearly hits. Among many objects, only those up to
    /// the first certain hit.
    [[nodiscard]] std::vector<TrueHit> hits_of(const StressRay& ray) const;
};

/// A group without rays.
[[nodiscard]] StressGroup stress_group(Scene scene);

/// A family's groups. Their scenes and rays depend on the seed and the family alone.
template <class Real>
[[nodiscard]] std::vector<StressGroup> make_groups(const StressFamily& family, std::uint64_t seed,
                                                   int rays);

// stress_subject.cpp

/// An accuracy of packets.
struct StressMode {
    const char* name;
    Accuracy accuracy;
    bool exact;  ///< it must decide as double does
};

inline constexpr StressMode stress_modes[] = {{"fast", Accuracy::fast, false},
                                              {"exact", Accuracy::exact, true}};

/// A kernel under test, in one mode and on one instruction set.
struct StressSubject {
    std::string kernel = {};
    std::string mode = {};  ///< empty but for packets
    std::string isa = {};   ///< empty but for packets
    bool exact = false;     ///< see StressMode
    RenderOptions options = {};
};

/// Whether `one` is among `chosen`, which if empty stands for all.
template <class T>
[[nodiscard]] bool wanted(const std::vector<T>& chosen, const std::type_identity_t<T>& one)
{
    return chosen.empty() || std::find(chosen.begin(), chosen.end(), one) != chosen.end();
}

/// The subjects that the options ask for.
[[nodiscard]] std::vector<StressSubject> stress_subjects(const StressOptions& options);

/// Rays as RayScene takes them.
template <class Real>
[[nodiscard]] RayColumns<Real> columns_of(const std::vector<StressRay>& rays)
{
    RayColumns<Real> columns;
    for (const StressRay& ray : rays)
        columns.add(ray.org, ray.dir, ray.t_min, ray.t_max);
    return columns;
}

template <class Real>
[[nodiscard]] Answer answer_of(const HitColumns<Real>& hits, std::size_t ray)
{
    return {hits.object[ray], hits.t[ray], vector_at(hits.normal, ray)};
}

/// Answers by ray, and the time of the closest hits. The textbook has `answers` only.
struct StressRun {
    std::vector<Answer> answers;
    std::vector<std::uint8_t> occluded;
    std::vector<std::int32_t> first;     ///< object of the first of all hits; -1 for none
    std::vector<std::size_t> crossings;  ///< number of all hits
    double seconds = 0.0;
};

template <class Real>
[[nodiscard]] StressRun run_subject(const StressSubject& subject, const StressGroup& group);

// second_hits.cpp

/// Results of the rays that leave hits.
struct SecondHits {
    std::uint64_t rays = 0;
    std::uint64_t taken = 0;  ///< self-intersections
    /// Second hits not found, or off by a tenth or more. By the notes' rule, rays on chords not
    /// four times as deep as the error of the hit point do not count.
    std::uint64_t lost = 0;
    /// Relative errors of t where the surface that the ray starts on is hit again.
    std::vector<float> errors;
    /// Errors beyond 1e-6 plus the uncertainty of t in double.
    std::uint64_t inexact = 0;

    void add(const SecondHits& other);
};

/// For packets. In groups with crossing planes no rays are traced.
template <class Real>
[[nodiscard]] SecondHits trace_second_hits(const StressSubject& subject, const StressGroup& group,
                                           SelfHits rule);

// bound_checks.cpp

/// Proven bounds of hits, compared with the truth.
struct BoundChecks {
    std::uint64_t bounds = 0;  ///< of true hits
    std::uint64_t missed = 0;  ///< that do not hold the true t
    std::vector<float> ulp;    ///< widths, in last places of double

    void add(const BoundChecks& other);
};

/// Checks the bounds of the closest hits of a group's rays, and of all their hits.
template <class Real>
[[nodiscard]] BoundChecks check_bounds(const StressSubject& subject, const StressGroup& group);

}  // namespace packtrace::lab
