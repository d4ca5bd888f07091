#pragma once

#include "core/quad.hpp"
#include <packtrace/scene.hpp>

#include <vector>

// Where a line hits a surface, in intervals that are proven to hold every hit.
namespace packtrace::bounds {

/// A line's points are org + t dir, of any length.
struct Line {
    Vec3 org{0.0};
    Vec3 dir{0.0};
};

/// Holds the t of so many hits at most, and of one at least where `certain`.
struct HitInterval {
    Quad low = 0;
    Quad high = 0;
    bool certain = false;
    int hits = 1;
};

/// Intervals with all hits of a line and a surface whose numbers are meant to the last digit, in
/// the order of their lower ends; they may overlap. An interval without end says that nothing could
/// be proven.
[[nodiscard]] std::vector<HitInterval> line_hits(const Surface& surface, const Mat4& transform,
                                                 const Line& line);

}  // namespace packtrace::bounds
