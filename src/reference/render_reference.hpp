#pragma once

#include "reference/ray_weight.hpp"
#include "reference/reference.hpp"
#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

namespace packtrace {

/// Renders a scene with the scalar reference, in float, double or long double. It uses these
/// options: threads, samples, adaptive, self_hits, progress, stop and region (within the picture).
/// Progress is called with the share of rows done, never falling. `cuts`, if given, counts the rays
/// that are not traced because of Scene::min_weight.
template <class Real>
[[nodiscard]] Image<Real> render_reference(const Scene& scene, const RenderOptions& options = {},
                                           reference::CutCounter* cuts = nullptr);

/// Renders rows of the picture into `image`, from row `first` on. They have the same bits as in the
/// whole picture.
template <class Real>
void render_reference_rows(const reference::Reference<Real>& reference, int picture_height,
                           const RenderOptions& options, int first, Image<Real>& image,
                           reference::CutCounter* cuts = nullptr);

}  // namespace packtrace
