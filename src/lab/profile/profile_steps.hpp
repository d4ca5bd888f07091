#pragma once

#include "kernel_abi/observation.hpp"
#include <packtrace/profile.hpp>

#include <functional>
#include <string>
#include <vector>

// The steps of a profile, in the order in which profile() takes them.
namespace packtrace {

[[nodiscard]] RenderOptions render_options(const ProfileOptions& options);

// timed_frames.cpp

/// Starts the threads and renders three frames: the first, one into other memory, and one into the
/// same. Only the first call of a process finds it cold, if nothing was rendered before.
template <class Real>
[[nodiscard]] std::vector<FirstFrameStep> first_frame_steps(const Scene& scene,
                                                            const ProfileOptions& options);

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

/// Renders all in turns, once more than asked: first frames pay for memory.
void take_times(std::vector<ProfileRun>& runs, const ProfileOptions& options);

/// How many of the runs behind the first end at a depth that is not the scene's, each one deeper
/// than the one before. With adaptive sampling they would refine other pixels.
[[nodiscard]] int generations_apart(const Scene& scene, const ProfileOptions& options);

/// The frame, then it ended after each depth but the last, then without one thing each. Names
/// are "frame", "depth 0" …, "without shadows" ….
template <class Real>
[[nodiscard]] std::vector<ProfileRun> profile_runs(const Scene& scene,
                                                   const ProfileOptions& options);

// kernel_profile.cpp

/// What kernels record of themselves in a frame, and the frame.
struct ObservedKernels {
    KernelProfile profile;
    std::vector<abi::WorkCounts> counts;  ///< by generation
    FrameCounts rays;
};

/// Frames of the same scene on one thread, observed and not, in turns.
template <class Real>
[[nodiscard]] ObservedKernels observe_kernels(const Scene& scene, const ProfileOptions& options);

// busy_machine.cpp

/// What of a profile was measured on too busy a machine, a sentence each. Figures that vary from
/// turn to turn by more than a tenth of a frame, and sums that are more than that off their whole,
/// are no figures.
[[nodiscard]] std::vector<std::string> busy_lines(const Profile& profile);

}  // namespace packtrace
