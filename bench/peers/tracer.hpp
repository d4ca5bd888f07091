#pragma once

#include "ray_set.hpp"

#include <functional>
#include <string>

namespace packtrace::peers {

enum class Query { closest, occluded };

/// Rays are handed over so many at a time, so that they and their hits stay in the second-level
/// cache of either side; filling the chunks and reading them does not count.
inline constexpr std::size_t chunk_size = 4096;

enum class Side { packtrace, embree_sphere, embree_user };

/// One way to trace a set of rays.
struct Tracer {
    std::string name;
    Side side = Side::packtrace;
    /// Only for camera rays, which it makes itself.
    bool camera_only = false;
    /// Seconds in which all rays were traced, on this thread.
    std::function<double(const RaySet&, Query, Hits&)> trace;
};

}  // namespace packtrace::peers
