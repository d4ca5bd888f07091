#pragma once

#include "tracer.hpp"

#include <string>
#include <vector>

namespace packtrace::peers {

/// A set of rays for one query. Shadow rays make two heats, one from each end.
struct Heat {
    std::string end;  ///< empty, "from the surface" or "from the light"
    Query query = Query::closest;
    RaySet rays;
};

/// The result of one tracer in one heat.
struct Result {
    std::string tracer;
    std::string end;
    Side side = Side::packtrace;
    /// It made its rays itself; they are rounded differently from those of the heat.
    bool own_rays = false;
    std::vector<double> seconds;  ///< of each pass
    double rays = 0.0;
    Hits hits{0};

    /// Million rays per second.
    [[nodiscard]] double median_rate() const;
    [[nodiscard]] double lowest_rate() const;
    [[nodiscard]] double highest_rate() const;
};

enum class HeatKind { camera, other };

/// Runs all tracers through all heats in each pass, so that a busy moment of the machine affects
/// all of them. A first pass does not count. Tracers for camera rays only run in heats of that
/// kind.
[[nodiscard]] std::vector<Result> race(const std::vector<Heat>& heats,
                                       const std::vector<Tracer>& tracers, HeatKind kind,
                                       int passes);

/// The fastest result of a side by its median; null if there is none.
[[nodiscard]] const Result* best_of(const std::vector<Result>& results, Side side);

/// Median over the passes of the time of `other` over that of `result`.
[[nodiscard]] double median_ratio(const Result& result, const Result& other);

}  // namespace packtrace::peers
