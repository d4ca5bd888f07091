#pragma once

#include <functional>
#include <string>
#include <vector>

#include <packtrace/profile.hpp>

namespace packtrace {

/// A frame to be timed against others.
struct ProfileRun {
    std::string name;
    std::function<FrameCounts()> render;
    bool does_more = false;            ///< than the frame
    FrameCounts rays = {};             ///< of the last frame
    std::vector<double> seconds = {};  ///< by repetition
};

/// What of two runs in turns one takes more than the other, of which it does a part.
struct TimeDifference {
    double seconds = 0.0;  ///< the median, 0 where it is negative
    double spread = 0.0;   ///< seconds; the middle half
};

[[nodiscard]] TimeDifference time_difference(const std::vector<double>& whole,
                                             const std::vector<double>& part);

[[nodiscard]] RenderOptions render_options(const ProfileOptions& options);

/// Renders all in turns, once more than asked: first frames pay for memory.
void take_times(std::vector<ProfileRun>& runs, const ProfileOptions& options);

/// The frame, then it ended after each depth but the last, then without one thing each. Names
/// are "frame", "depth 0" …, "without shadows" ….
template <class Real>
[[nodiscard]] std::vector<ProfileRun> profile_runs(const Scene& scene,
                                                   const ProfileOptions& options);

}  // namespace packtrace
