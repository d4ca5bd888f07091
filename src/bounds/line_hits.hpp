#pragma once

#include "core/quad.hpp"
#include <packtrace/scene.hpp>

#include <vector>

// Where a line hits a surface, in intervals that are proven to hold every hit.
namespace packtrace::bounds {

/// The points org + t dir; `dir` of any length.
struct Line {
    Vec3 org{0.0};
    Vec3 dir{0.0};
};

/// Holds the t of at most `hits` hits, and of at least one where `certain`.
struct HitInterval {
    Quad low = 0;
    Quad high = 0;
    bool certain = false;
    int hits = 1;
};

/// Intervals that hold all hits of a line with a surface, whose numbers are taken as exact; in the
/// order of their lower ends. They may overlap. An infinite interval says that nothing could be
/// proven.
[[nodiscard]] std::vector<HitInterval> line_hits(const Surface& surface, const Mat4& transform,
                                                 const Line& line);

}  // namespace packtrace::bounds
