#pragma once

#include <limits>
#include <vector>

#include "lab/truth/wide_surface.hpp"

// What a ray really hits, how sensitive that is, and how far it is from being otherwise.
namespace packtrace::lab {

/// A ray with the bits the kernels are given.
struct StressRay {
    Vec3 org{0.0};
    Vec3 dir{0.0};
    double t_min = 0.0;
    double t_max = 0.0;
    bool exact = false;  ///< its inputs are meant to the last digit: nothing is undecided
};

/// A place where a ray hits a surface, or would after a small change of its inputs.
struct TrueHit {
    bool exists = false;
    Wide t = 0;
    std::int32_t object = -1;
    int piece = 0;           ///< 0: side, 1 and 2: low and high cap
    WideVec normal;          ///< unit, outwards; 0 where there is none
    double spread = 0.0;     ///< change of t for relative changes 1 of every input
    double condition = 0.0;  ///< the same over t
    double margin = 0.0;     ///< relative change of the inputs that makes `exists` another
    /// How far t is, by its own size, from an end of the range other than 0.
    double end_gap = std::numeric_limits<double>::infinity();
    double normal_spread = 0.0;  ///< turn of the normal for relative changes 1 of every input
    /// Relative change of the inputs that makes the normal another.
    double side_margin = std::numeric_limits<double>::infinity();
};

/// Appends the hits of one ray with one surface, whatever their t.
void find_true_hits(const WideSurface& surface, const StressRay& ray, std::vector<TrueHit>& found);

}  // namespace packtrace::lab
