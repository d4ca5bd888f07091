#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <packtrace/render.hpp>

namespace packtrace::study {

struct StressOptions {
    std::vector<std::string> families;    ///< by name; empty: all
    std::vector<std::string> kernels;     ///< packet, scalar, naive; empty: all
    std::vector<std::string> modes;       ///< fast, auto, robust; empty: all; packets only
    std::vector<std::string> precisions;  ///< single, double; empty: both
    std::string isa;                      ///< empty: all that run here
    int rays = 2000;                      ///< of each family and precision
    std::uint64_t seed = 1;
};

/// One kernel in one mode on one family.
struct StressRow {
    std::string family;
    std::string precision;  ///< single, double
    std::string kernel;     ///< packet, scalar, naive
    std::string mode;       ///< fast, auto, robust; empty but for packets
    std::string isa;        ///< those that gave the same bits, parted by spaces
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t undecidable = 0;
    std::uint64_t wrong = 0;
    std::uint64_t wrong_in_band = 0;
    std::uint64_t not_finite = 0;
    double ulp_median = 0.0;
    double ulp_p99 = 0.0;
    double ulp_max = 0.0;
    double rho = 0.0;
    double distance = 0.0;
    double normal = 0.0;
    double relative = 0.0;
    // Secondary rays from the hits: own starts taken for hits, and second meetings lost, with
    // SelfHits::note and SelfHits::exact.
    std::uint64_t secondary = 0;
    std::uint64_t note_taken = 0;
    std::uint64_t note_lost = 0;
    std::uint64_t exact_taken = 0;
    std::uint64_t exact_lost = 0;
    double ns = 0.0;                  ///< a ray, of the first of the instruction sets
    bool pareto = false;              ///< no other of the family is both quicker and more exact
    std::vector<std::string> broken;  ///< stated bounds that do not hold
};

/// Runs families of extreme rays through the kernels and holds the answers against 113 bits.
/// `take` gets the rows of one family after the other. Throws std::invalid_argument for a name
/// that is none.
void run_stress(const StressOptions& options,
                const std::function<void(const std::vector<StressRow>&)>& take);

/// Names and descriptions of all families.
struct StressFamilyInfo {
    std::string name;
    std::string what;
};
[[nodiscard]] std::vector<StressFamilyInfo> list_stress_families();

}  // namespace packtrace::study
