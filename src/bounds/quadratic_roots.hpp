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

/// Holds so many roots at most, and one at least where `certain`.
struct RootInterval {
    Quad low;
    Quad high;
    bool certain;
    int roots;
};

/// Intervals with all roots of a quadratic of which only what is given is known. `from(t)` is that
/// from the line's point at t on: the nearer it lies to a root, the more exact that becomes.
/// `start` is a point near all of the surface's middle. An identical zero has no roots.
[[nodiscard]] std::vector<RootInterval> roots_of(const std::function<Quadratic(Quad)>& from,
                                                 Quad start);

}  // namespace packtrace::bounds
