#pragma once

#include "bounds/ball.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace packtrace::bounds {

/// F(s) = a s² + 2 b s + c, a quadratic along a line from one of its points.
struct Quadratic {
    Ball a;
    Ball b;
    Ball c;
};

/// Holds at most `roots` roots, and at least one where `certain`.
struct RootInterval {
    Quad low;
    Quad high;
    bool certain;
    int roots;
};

/// Intervals that hold all roots of a quadratic whose coefficients are known as balls. `from(t)`
/// gives the quadratic relative to the line's point at t: the nearer t is to a root, the more exact
/// its coefficients. `start` is the t of a point near the middle of the surface. A quadratic that
/// is zero everywhere has no roots.
[[nodiscard]] std::vector<RootInterval> roots_of(const std::function<Quadratic(Quad)>& from,
                                                 Quad start);

}  // namespace packtrace::bounds
