#pragma once

#include "geometry/canonical_form.hpp"
#include "lab/truth/wide.hpp"
#include <packtrace/scene.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

// What a ray really hits, how sensitive that is, and how far it is from being otherwise.
namespace packtrace::lab {

// wide_surface.cpp

/// A surface of any kind as p·S p + 2 l·p + c = 0 in its own space, negative inside, and its way
/// into the world; exactly what the scene says.
struct WideSurface {
    WideVec square[3];  ///< rows of the symmetric S
    WideVec linear;
    Wide constant = 0;
    bool placed = false;  ///< false: own space is the world's
    WideVec world[3];     ///< rows of own to world
    WideVec own[3];       ///< rows of world to own
    WideVec offset;       ///< where own 0 is in the world
    /// Magnitudes of what places the surface besides its own points: a centre, a point, an offset.
    WideVec place;
    bool by_points = true;  ///< own points count as inputs: not for spheres and planes
    /// Of a general quadric: what kernels hold it by, whose entries count as inputs.
    std::optional<CanonicalForm> canonical;
    std::optional<ZRange> z_range;
    bool capped = false;
    /// Of x² = z² and its like: normals of the two planes, whose product the equation is.
    std::optional<std::array<WideVec, 2>> sheets;
    /// Edges of a polygon, two ends each; `linear` is half a normal of its plane.
    std::vector<std::array<WideVec, 2>> edges;
    /// Of a sphere: far from the origin the equation's other terms would cancel.
    std::optional<Wide> radius2;
    std::int32_t object = 0;

    explicit WideSurface(const Object& from, std::int32_t number);

    [[nodiscard]] WideVec point_to_own(const WideVec& P) const;
    [[nodiscard]] WideVec direction_to_own(const WideVec& d) const;
    [[nodiscard]] Wide value(const WideVec& p) const;
    /// Half the gradient of `value`.
    [[nodiscard]] WideVec gradient(const WideVec& p) const;
    [[nodiscard]] WideVec second_order(const WideVec& v) const;
    /// Covectors go into the world by the transposed inverse.
    [[nodiscard]] WideVec covector_to_world(const WideVec& n) const;
};

// wide_truth.cpp

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

// expected_hit.cpp

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

/// What a kernel said of a ray.
struct Answer {
    std::int32_t object = -1;  ///< -1 for a miss
    double t = 0.0;
    Vec3 normal{0.0};
};

}  // namespace packtrace::lab
