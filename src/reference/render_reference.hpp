#pragma once

#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>

#include <functional>

namespace packtrace {

/// Renders a scene with the scalar reference, in float, double or long double. `threads` is as
/// in RenderOptions: 0 for all of the TBB arena the call runs in. `progress` gets the share of
/// rows done, from any thread, one call at a time, never falling.
template <class Real>
[[nodiscard]] Image<Real> render_reference(const Scene& scene, int threads = 0,
                                           const std::function<void(double)>& progress = {});

}  // namespace packtrace
