#pragma once

#include <packtrace/render.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace packtrace::lab {

/// Runs timed work while other processes of the same job on this machine are idle. Empty if there
/// are no other processes.
using Alone = std::function<void(const std::function<void()>& timed)>;

inline void run_alone(const Alone& alone, const std::function<void()>& timed)
{
    alone ? alone(timed) : timed();
}

struct StressOptions {
    std::vector<std::string> families = {};  ///< by name; empty: all
    std::vector<std::string> kernels = {};   ///< packet, scalar, textbook; empty: all
    std::vector<std::string> modes = {};     ///< of stress_modes; empty: all; packets only
    std::vector<Precision> precisions = {};  ///< single, double_; empty: both
    std::string isa = {};                    ///< empty: all that run here
    SelfHits self_hits = SelfHits::exact;    ///< how second rays avoid the surface they start on
    Traversal traversal = Traversal::automatic;
    int rays = 4096;  ///< for each family and precision
    std::uint64_t seed = 1;
    int first_family = 0;     ///< index of the first family to run, of the wanted ones
    int family_step = 1;      ///< step from one index to the next
    bool second_hits = true;  ///< also trace rays that leave the hits
    bool bounds = true;       ///< also check proven bounds; computes the truth once more
    Alone alone = {};         ///< for timed work
};

/// Quantiles of errors.
struct ErrorSpread {
    double median = 0.0;
    double p99 = 0.0;
    double max = 0.0;
};

/// How often answers are wrong, and by how much. An answer is wrong if double can decide that it
/// is, unless another band is named.
struct ErrorCounts {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t undecided = 0;  ///< rays that double cannot decide either
    std::uint64_t lost = 0;
    std::uint64_t false_hits = 0;
    std::uint64_t wrong_object = 0;
    std::uint64_t wrong_root = 0;  ///< of the right object
    std::uint64_t occluded = 0;    ///< any-hit answers that are wrong
    std::uint64_t order = 0;  ///< the first of all hits is on another object than the closest hit
    std::uint64_t not_closed = 0;       ///< closed bodies not left as often as they are entered
    std::uint64_t beyond_own_band = 0;  ///< wrong also outside the band of the kernel's precision
    std::uint64_t not_finite = 0;       ///< hits whose t or normal is not finite
    std::uint64_t no_normal = 0;        ///< normals that are not of length 1
    std::uint64_t wrong_side = 0;       ///< normals turned to the other side of the ray
    std::uint64_t t_beyond = 0;         ///< t off by more than 1 ulp plus its uncertainty in double
    std::uint64_t t_beyond_half = 0;    ///< the same for 0.51 ulp
    std::uint64_t t_at_limit = 0;  ///< t off by more than 1 ulp, within its uncertainty in double
    std::uint64_t normal_beyond = 0;  ///< normals off by more than 1e-6
    double rho = 0.0;                 ///< largest error of t over the error by rounding the inputs
    double distance = 0.0;  ///< of mirrored rays, largest error of hit points, in roundoffs
};

/// A count and its key in JSON.
struct ErrorCount {
    const char* key;
    std::uint64_t ErrorCounts::*count;
};

/// In the order of JSON.
inline constexpr std::array<ErrorCount, 18> error_counts{
    {{"rays", &ErrorCounts::rays},
     {"hits", &ErrorCounts::hits},
     {"undecided", &ErrorCounts::undecided},
     {"lost", &ErrorCounts::lost},
     {"false_hits", &ErrorCounts::false_hits},
     {"wrong_object", &ErrorCounts::wrong_object},
     {"wrong_root", &ErrorCounts::wrong_root},
     {"any_hit_wrong", &ErrorCounts::occluded},
     {"first_of_all_wrong", &ErrorCounts::order},
     {"not_closed", &ErrorCounts::not_closed},
     {"wrong_beyond_own_band", &ErrorCounts::beyond_own_band},
     {"not_finite", &ErrorCounts::not_finite},
     {"no_normal", &ErrorCounts::no_normal},
     {"wrong_side", &ErrorCounts::wrong_side},
     {"t_beyond_ulp", &ErrorCounts::t_beyond},
     {"t_beyond_half_ulp", &ErrorCounts::t_beyond_half},
     {"t_at_doubles_limit", &ErrorCounts::t_at_limit},
     {"normal_beyond_1e-6", &ErrorCounts::normal_beyond}}};

/// The results of one kernel in one mode on one family.
struct StressRow : ErrorCounts {
    std::string family;
    Precision precision = Precision::single;  ///< or double_
    std::string kernel;                       ///< packet, scalar, textbook
    std::string mode;         ///< of stress_modes; "any" for packets of doubles, empty for others
    std::string isa;          ///< those that gave the same bits, separated by spaces
    bool held = false;        ///< it counts for the verdict
    std::uint64_t wrong = 0;  ///< closest hits: lost, false, of the wrong object or root
    ErrorSpread ulp;          ///< of t, in units in the last place of the precision
    ErrorSpread normal;
    // Rays that leave the hits.
    std::uint64_t second_rays = 0;
    std::uint64_t self_hits = 0;
    std::uint64_t second_lost = 0;
    std::uint64_t second_inexact = 0;  ///< t off by more than 1e-6 plus its uncertainty in double
    ErrorSpread second;                ///< relative errors of t
    // Proven bounds of t; only of rows that count for the verdict.
    std::uint64_t bounds = 0;
    std::uint64_t bounds_missed = 0;  ///< that do not hold the true t
    ErrorSpread bounds_ulp;           ///< widths, in last places of double
    double ns = 0.0;                  ///< per ray, of the first of the instruction sets
    bool pareto = false;              ///< no other row of the family is both faster and more exact
    std::string example_scene;        ///< the scene of the first wrong answer
    std::string example_ray;  ///< the ray of the first wrong answer, for `packtrace intersect`
    std::string example;      ///< the first wrong answer
    std::vector<std::string> faults;  ///< that count for the verdict
};

/// Runs families of extreme rays through the kernels and compares the answers with the truth in 113
/// bits. `take` receives the rows of each family in turn. Throws std::invalid_argument for an
/// unknown name.
void run_stress(const StressOptions& options,
                const std::function<void(const std::vector<StressRow>&)>& take);

/// The names of the families that run_stress() runs with these options, in order.
[[nodiscard]] std::vector<std::string> chosen_families(const StressOptions& options);

/// The same work in parts, each a family in one precision. Their rows in order are those of the
/// whole.
[[nodiscard]] std::vector<StressOptions> stress_parts(const StressOptions& options);

/// The name and the description of a family.
struct StressFamilyInfo {
    std::string name;
    std::string what;
};
[[nodiscard]] std::vector<StressFamilyInfo> list_stress_families();

// stress_verdict.cpp

/// The faults of a row that counts for the verdict, each in a few words.
[[nodiscard]] std::vector<std::string> faults_of(const StressRow& row);

/// The same for a row of a StressMeasure.
[[nodiscard]] std::vector<std::string> faults_of_measure(const StressRow& row);

/// One line on all rows that count for the verdict.
[[nodiscard]] std::string stress_verdict(const std::vector<StressRow>& rows);

/// Whether no row has a fault.
[[nodiscard]] bool without_faults(const std::vector<StressRow>& rows);

}  // namespace packtrace::lab
