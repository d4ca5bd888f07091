#pragma once

#include "ray_set.hpp"

#include <functional>
#include <string>

namespace packtrace::peers {

enum class Query { closest, occluded };

/// Rays in one call: few enough for them and their hits to stay in the second-level cache. Filling
/// and reading chunks is not timed.
inline constexpr std::size_t chunk_size = 4096;

enum class Side { packtrace, embree_sphere, embree_user };

/// One way to trace a set of rays.
struct Tracer {
    std::string name;
    Side side = Side::packtrace;
    /// It traces camera rays only, which it makes itself.
    bool camera_only = false;
    /// Traces all rays on this thread; returns seconds.
    std::function<double(const RaySet&, Query, Hits&)> trace;
};

}  // namespace packtrace::peers
