#pragma once

#include "tracer.hpp"

#include <string>
#include <vector>

namespace packtrace::peers {

/// Rays that are traced in one query; a kind may come from two ends, as shadow rays do.
struct Heat {
    std::string end;  ///< empty, "from the surface" or "from the light"
    Query query = Query::closest;
    RaySet rays;
};

/// How fast one tracer was in one heat.
struct Result {
    std::string tracer;
    std::string end;
    Side side = Side::packtrace;
    /// It made its rays itself, rounded in another way than those of the heat.
    bool own_rays = false;
    std::vector<double> seconds;  ///< of each pass
    double rays = 0.0;
    Hits hits{0};

    /// Million rays a second.
    [[nodiscard]] double median_rate() const;
    [[nodiscard]] double lowest_rate() const;
    [[nodiscard]] double highest_rate() const;
};

/// Runs every tracer once a pass through every heat, after a pass that does not count, so that
/// a busy moment of the machine falls on all of them.
[[nodiscard]] std::vector<Result> race(const std::vector<Heat>& heats,
                                       const std::vector<Tracer>& tracers, bool camera, int passes);

/// The fastest of a side by its median; null when it did not run.
[[nodiscard]] const Result* best_of(const std::vector<Result>& results, Side side);

/// Median over the passes of how many times `result` is as fast as `other`.
[[nodiscard]] double median_ratio(const Result& result, const Result& other);

}  // namespace packtrace::peers
