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
    FrameCounts rays;             ///< of the last frame
    std::vector<double> seconds;  ///< by repetition
};

[[nodiscard]] RenderOptions render_options(const ProfileOptions& options);

/// Renders all in turns, once more than asked: first frames pay for memory.
void take_times(std::vector<ProfileRun>& runs, int repetitions);

/// The frame, then it ended after each depth but the last, then without one thing each. Names
/// are "frame", "depth 0" …, "without shadows" ….
template <class Real>
[[nodiscard]] std::vector<ProfileRun> profile_runs(const Scene& scene,
                                                   const ProfileOptions& options);

}  // namespace packtrace
