#pragma once

#include <packtrace/profile.hpp>

namespace packtrace {

/// Starts the threads and renders three frames: the first, one into other memory, and one into the
/// same. Only the first call of a process finds it cold, if nothing was rendered before.
template <class Real>
[[nodiscard]] std::vector<FirstFrameStep> first_frame_steps(const Scene& scene,
                                                            const ProfileOptions& options);

}  // namespace packtrace
