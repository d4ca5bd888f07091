#pragma once

#include "geometry/canonical_form.hpp"
#include "lab/truth/wide.hpp"
#include <packtrace/scene.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

// The truth of a ray in 113 bits: its hits, how sensitive they are to the inputs, and how small a
// change of the inputs would change them.
namespace packtrace::lab {

// wide_surface.cpp

/// A surface of any kind as p·S p + 2 l·p + c = 0 in its own space, negative inside, and its
/// placement in the world. The scene's numbers are taken as exact.
struct WideSurface {
    WideVec square[3];  ///< rows of the symmetric S
    WideVec linear;
    Wide constant = 0;
    bool placed = false;  ///< false: own space is the world's
    WideVec world[3];     ///< rows of own to world
    WideVec own[3];       ///< rows of world to own
    WideVec offset;       ///< the origin of own space in the world
    /// Magnitudes of the numbers that place the surface, besides its own points: a centre, a point,
    /// an offset.
    WideVec place;
    bool by_points = true;  ///< own points count as inputs; always so for quadrics
    /// Of a general quadric: its form in the kernels, whose entries count as inputs.
    std::optional<CanonicalForm> canonical;
    std::optional<ZRange> z_range;
    bool capped = false;
    /// Of a quadric such as x² = z²: normals of the two planes whose product is the equation.
    std::optional<std::array<WideVec, 2>> sheets;
    /// Edges of a polygon, two ends each; `linear` is half a normal of its plane.
    std::vector<std::array<WideVec, 2>> edges;
    /// Of a sphere. Far from the origin the other terms of the equation would cancel.
    std::optional<Wide> radius2;
    std::int32_t object = 0;

    explicit WideSurface(const Object& from, std::int32_t number);

    [[nodiscard]] WideVec point_to_own(const WideVec& P) const;
    [[nodiscard]] WideVec direction_to_own(const WideVec& d) const;
    [[nodiscard]] Wide value(const WideVec& p) const;
    /// Half the gradient of `value`.
    [[nodiscard]] WideVec gradient(const WideVec& p) const;
    [[nodiscard]] WideVec second_order(const WideVec& v) const;
    /// By the transposed inverse.
    [[nodiscard]] WideVec covector_to_world(const WideVec& n) const;
};

// wide_truth.cpp

/// A ray, with the bits that the kernels get.
struct StressRay {
    Vec3 org{0.0};
    Vec3 dir{0.0};
    double t_min = 0.0;
    double t_max = 0.0;
    bool exact = false;  ///< its inputs count as exact: every decision about it is held to
};

/// A hit of a ray, or a place that would be a hit after a small change of the inputs.
struct TrueHit {
    bool exists = false;
    Wide t = 0;
    std::int32_t object = -1;
    int piece = 0;           ///< 0: side, 1 and 2: low and high cap
    WideVec normal;          ///< unit, outwards; 0 where there is none
    double spread = 0.0;     ///< change of t for relative changes 1 of every input
    double condition = 0.0;  ///< spread / t
    double margin = 0.0;     ///< relative change of the inputs that changes `exists`
    /// Distance of t from an end of the ray interval other than 0, relative to t.
    double end_gap = std::numeric_limits<double>::infinity();
    double normal_spread = 0.0;  ///< turn of the normal for relative changes 1 of every input
    /// Relative change of the inputs that changes the normal to that of another surface.
    double side_margin = std::numeric_limits<double>::infinity();
};

/// Appends the hits of one ray with one surface at any t.
void find_true_hits(const WideSurface& surface, const StressRay& ray, std::vector<TrueHit>& found);

// expected_hit.cpp

/// Kernels are not held to a decision that changes when the inputs change by this many unit
/// roundoffs or fewer.
inline constexpr double undecided_band = 4.0;

/// The same relative to the inputs in double: decisions in this band cannot be made in double.
inline constexpr double double_band = undecided_band * 0x1p-53;

/// The right answer, a hit or a miss. It follows from the truth alone.
struct Expected {
    std::int32_t object = -1;  ///< -1 for a miss
    int piece = 0;             ///< of the object, as in TrueHit
    Wide t = 0;
    Vec3 normal{0.0};            ///< unit, outwards; 0 where the surface has none
    double cosine = 0.0;         ///< of ray and normal: below 0 where the ray enters
    double condition = 0.0;      ///< of t
    double normal_spread = 0.0;  ///< turn of the normal for relative changes 1 of every input
    /// Relative change of the inputs that makes another object, or a miss, the answer.
    double margin = 0.0;
    /// Relative change that makes another hit of the same object the answer, or changes its normal.
    double root_margin = 0.0;
    /// Relative change that brings some hit to within a last place of t of an end of the ray
    /// interval.
    double end_margin = 0.0;
    bool certain = false;       ///< the ray starts inside a closed body: it must hit something
    bool even = false;          ///< it starts outside a closed body: the number of hits is even
    std::vector<TrueHit> hits;  ///< all that exist or nearly exist, by t, then object

    [[nodiscard]] bool decided(double band) const
    {
        return margin >= band && end_margin >= band;
    }
    [[nodiscard]] bool root_decided(double band) const
    {
        return decided(band) && root_margin >= band;
    }
};

/// Relative change of the inputs that brings a hit to within a last place of t of an end of the ray
/// interval other than 0.
[[nodiscard]] double margin_of_end(const TrueHit& hit, double roundoff);

/// `roundoff` is that of the kernels' precision: they compare the ends of the ray interval with the
/// rounded t.
[[nodiscard]] Expected expect(const StressRay& ray, std::vector<TrueHit> hits, double roundoff);

/// A kernel's answer to a ray.
struct Answer {
    std::int32_t object = -1;  ///< -1 for a miss
    double t = 0.0;
    Vec3 normal{0.0};
};

}  // namespace packtrace::lab
