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
/// same memory. They show a cold start only in the first call of a process that has rendered
/// nothing.
template <class Real>
[[nodiscard]] std::vector<FirstFrameStep> first_frame_steps(const Scene& scene,
                                                            const ProfileOptions& options);

/// A variant of the frame to be timed.
struct ProfileRun {
    std::string name;
    std::function<FrameCounts()> render;
    bool does_more = false;            ///< than the frame; others do less
    FrameCounts rays = {};             ///< of the last frame
    std::vector<double> seconds = {};  ///< by repetition
};

/// How much longer a run takes than another one that does a part of its work.
struct TimeDifference {
    double seconds = 0.0;  ///< the median; 0 if it is negative
    double spread = 0.0;   ///< seconds; width of the middle half
};

[[nodiscard]] TimeDifference time_difference(const std::vector<double>& whole,
                                             const std::vector<double>& part);

/// Times all runs by turns. A first turn does not count, because first frames allocate memory.
void take_times(std::vector<ProfileRun>& runs, const ProfileOptions& options);

/// How many of profile_runs(), after the first, end at a smaller depth than the scene's, from depth
/// 0 on. None with adaptive sampling, where they would refine other pixels.
[[nodiscard]] int generations_apart(const Scene& scene, const ProfileOptions& options);

/// The frame; the frame with each smaller depth; and the frame without one thing each. Their names
/// are "frame", "depth 0" …, "without shadows" ….
template <class Real>
[[nodiscard]] std::vector<ProfileRun> profile_runs(const Scene& scene,
                                                   const ProfileOptions& options);

// kernel_profile.cpp

/// What observing kernels recorded in frames.
struct ObservedKernels {
    KernelProfile profile;
    std::vector<abi::WorkCounts> counts;  ///< by generation
    FrameCounts rays;
};

/// Renders frames on one thread, observed and not, by turns.
template <class Real>
[[nodiscard]] ObservedKernels observe_kernels(const Scene& scene, const ProfileOptions& options);

// busy_machine.cpp

/// The parts of a profile that a busy machine made useless, in a sentence each: figures that vary
/// from turn to turn by more than a tenth of a frame, and sums that differ by more than a tenth
/// from their whole.
[[nodiscard]] std::vector<std::string> busy_lines(const Profile& profile);

}  // namespace packtrace
