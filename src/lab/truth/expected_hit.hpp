#pragma once

#include <vector>

#include "lab/truth/wide_truth.hpp"

namespace packtrace::lab {

/// Relative changes of the inputs, in unit roundoffs, within which a decision is not held to.
inline constexpr double undecided_band = 4.0;

/// What double itself cannot decide: a change of the inputs by this may turn it.
inline constexpr double double_band = undecided_band * 0x1p-53;

/// The one hit that is the right answer, or the miss; fixed by the truth, before any answer.
struct Expected {
    std::int32_t object = -1;  ///< -1 for a miss
    int piece = 0;             ///< of the object, as in TrueHit
    Wide t = 0;
    Vec3 normal{0.0};            ///< unit, outwards; 0 where the surface has none
    double cosine = 0.0;         ///< of the ray and the normal: below 0 where it enters
    double condition = 0.0;      ///< of t
    double normal_spread = 0.0;  ///< turn of the normal for relative changes 1 of every input
    /// Relative change of the inputs that makes another object, or a miss, the answer.
    double margin = 0.0;
    /// The same that makes another hit of the same object the answer, or turns its normal.
    double root_margin = 0.0;
    /// The same that brings some hit to within a last place of t of an end of the range.
    double end_margin = 0.0;
    bool certain = false;       ///< from inside a closed body: there is a hit, whatever the margins
    bool even = false;          ///< from outside a closed body: it is left as often as entered
    std::vector<TrueHit> hits;  ///< all, by t, then object; also such as nearly exist

    [[nodiscard]] bool decided(double band) const
    {
        return margin >= band && end_margin >= band;
    }
    [[nodiscard]] bool root_decided(double band) const
    {
        return decided(band) && root_margin >= band;
    }
};

/// Relative change of the inputs that brings a hit to within a last place of t of an end of the
/// ray's range other than 0.
[[nodiscard]] double margin_of_end(const TrueHit& hit, double roundoff);

/// `roundoff` is that of the precision that t is given in: a range's ends are compared with t as
/// rounded.
[[nodiscard]] Expected expect(const StressRay& ray, std::vector<TrueHit> hits, double roundoff);

}  // namespace packtrace::lab
