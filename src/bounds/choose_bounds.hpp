#pragma once

#include <span>

#include <packtrace/intersect.hpp>

#include "bounds/line_hits.hpp"

namespace packtrace::bounds {

/// The part of a line where hits count: t_min < t < t_max.
struct Range {
    double t_min = 0.0;
    double t_max = 0.0;
};

/// Bounds of the first hit in the range, from line_hits(); empty where there surely is none.
[[nodiscard]] HitBounds first_of(std::span<const HitInterval> hits, const Range& range);

/// Bounds of each of several hits in the range, whose rounded t are given in rising order.
void bounds_of(std::span<const HitInterval> hits, const Range& range, std::span<const double> t,
               std::span<HitBounds> bounds);

}  // namespace packtrace::bounds
