#pragma once

#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include "reference/cut_rays.hpp"

namespace packtrace {

/// Renders a scene with the scalar reference, in float, double or long double. Threads, sampling,
/// self-hits and progress count of the options, the latter called with the share of rows done,
/// never falling. Rays that Scene::min_weight leaves out are added to `cuts`, if any.
template <class Real>
[[nodiscard]] Image<Real> render_reference(const Scene& scene, const RenderOptions& options = {},
                                           reference::CutCounter* cuts = nullptr);

}  // namespace packtrace
