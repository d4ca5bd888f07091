#pragma once

#include "reference/ray_weight.hpp"
#include "reference/reference.hpp"
#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

namespace packtrace {

/// Renders a scene with the scalar reference, in float, double or long double. Threads, sampling,
/// self-hits, progress, stop and region (within the picture) count of the options, the latter
/// called with the share of rows done, never falling. Rays that Scene::min_weight leaves out are
/// added to `cuts`, if any.
template <class Real>
[[nodiscard]] Image<Real> render_reference(const Scene& scene, const RenderOptions& options = {},
                                           reference::CutCounter* cuts = nullptr);

/// The same for the rows of `image` alone, the first of which is row `first` of the picture. They
/// have the bits they have in the whole picture.
template <class Real>
void render_reference_rows(const reference::Reference<Real>& reference, int picture_height,
                           const RenderOptions& options, int first, Image<Real>& image,
                           reference::CutCounter* cuts = nullptr);

}  // namespace packtrace
