#pragma once

#include <limits>
#include <vector>

#include "study/wide_surface.hpp"

// What a ray really meets, how sensitive that is, and how far it is from being otherwise.
namespace packtrace::study {

/// A ray with the bits the kernels are given.
struct StressRay {
    Vec3 org{0.0};
    Vec3 dir{0.0};
    double t_min = 0.0;
    double t_max = 0.0;
};

/// A place where a ray meets a surface, or would after a small change of its inputs.
struct Meeting {
    bool exists = false;
    Wide t = 0;
    std::int32_t object = -1;
    WideVec normal;          ///< unit, outwards
    double condition = 0.0;  ///< relative change of t for relative changes 1 of every input
    double margin = 0.0;     ///< relative change of the inputs that makes `exists` another
    /// The same for the ends of the range other than 0, which t is compared with as rounded.
    double end_margin = std::numeric_limits<double>::infinity();
};

/// Appends the meetings of one ray with one surface.
void find_meetings(const WideSurface& surface, const StressRay& ray, std::vector<Meeting>& found);

/// How far the world point P is from the surface, to first order.
[[nodiscard]] double distance_to(const WideSurface& surface, const WideVec& P);

}  // namespace packtrace::study
