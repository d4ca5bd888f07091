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

// Groups of rays with their truth, the kernels that are tried, and what each is asked of a group.
namespace packtrace::lab {

/// Half the distance from 1 to the next number.
template <class Real>
inline constexpr double roundoff_of = double{std::numeric_limits<Real>::epsilon()} / 2.0;

// stress_group.cpp

/// What is left of a sphere for a quick test in double that no line near it fails.
struct SphereScreen {
    Vec3 center{0.0};
    double radius = -1.0;  ///< below 0: no sphere, or a placed one
    double slack = 0.0;    ///< by which it is widened
};

/// Rays of one scene with all that is known of them.
struct StressGroup {
    Scene scene;
    std::vector<WideSurface> surfaces;
    std::vector<SphereScreen> screens;
    std::vector<StressRay> rays;
    std::vector<Expected> expected;  ///< by ray

    /// All hits of a ray, and what it nearly hits. Among many objects, those up to the first that
    /// is beyond doubt.
    [[nodiscard]] std::vector<TrueHit> hits_of(const StressRay& ray) const;
};

/// A scene as its truth sees it.
[[nodiscard]] StressGroup stress_group(Scene scene);

/// The same scenes and rays whatever else is run: they follow from seed and family alone.
template <class Real>
[[nodiscard]] std::vector<StressGroup> make_groups(const StressFamily& family, std::uint64_t seed,
                                                   int rays);

// stress_subject.cpp

/// An accuracy of packets; `exact` ones are held to deciding as double does.
struct StressMode {
    const char* name;
    Accuracy accuracy;
    bool exact;
};

inline constexpr StressMode stress_modes[] = {{"fast", Accuracy::fast, false},
                                              {"exact", Accuracy::exact, true}};

/// A kernel in one mode, on one instruction set.
struct StressSubject {
    std::string kernel;
    std::string mode;
    std::string isa;
    bool exact = false;
    RenderOptions options;
};

/// Whether `one` is among those `chosen`; where none are all are.
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

/// Answers by ray, and what the closest hits took. The textbook has no more than those.
struct StressRun {
    std::vector<Answer> answers;
    std::vector<std::uint8_t> occluded;
    std::vector<std::int32_t> first;     ///< object of the first of all hits
    std::vector<std::size_t> crossings;  ///< how many hits there are
    double seconds = 0.0;
};

template <class Real>
[[nodiscard]] StressRun run_subject(const StressSubject& subject, const StressGroup& group);

// second_hits.cpp

/// Rays that leave hits, and what they hit next.
struct SecondHits {
    std::uint64_t rays = 0;
    std::uint64_t taken = 0;  ///< hits of the own surface at the start, or where there is none
    /// Second hits not found, or found a tenth or more off; by the notes' rule only those by
    /// chords four times deeper than the hit point is off.
    std::uint64_t lost = 0;
    /// Relative errors of t where the own surface is hit again.
    std::vector<float> errors;
    /// Those beyond 1e-6 and what the inputs' rounding makes of t in double.
    std::uint64_t inexact = 0;

    void add(const SecondHits& other);
};

/// For packets; of groups with crossing planes nothing is counted.
template <class Real>
[[nodiscard]] SecondHits trace_second_hits(const StressSubject& subject, const StressGroup& group,
                                           SelfHits rule);

// bound_checks.cpp

/// Proven bounds of hits, held against the truth.
struct BoundChecks {
    std::uint64_t bounds = 0;  ///< of hits that there truly are
    std::uint64_t missed = 0;  ///< that do not hold the true t
    std::vector<float> ulp;    ///< how far apart they are, in last places of double

    void add(const BoundChecks& other);
};

/// Bounds of the closest hits of a group's rays, and of all hits.
template <class Real>
[[nodiscard]] BoundChecks check_bounds(const StressSubject& subject, const StressGroup& group);

}  // namespace packtrace::lab
