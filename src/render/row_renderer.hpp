#pragma once

#include <packtrace/renderer.hpp>

#include <functional>

namespace packtrace {

/// Renders the rows of `image`; its first row is row `first` of the picture. The rows equal those
/// of the whole picture, bit for bit. Rows must be whole tiles, as for
/// FrameRenderer::render_rows(). Only packets count their rays; every kernel counts the rays that
/// are cut.
template <class Real>
using RenderRows = std::function<FrameCounts(int first, Image<Real>& image)>;

/// Prepares a scene to be rendered some rows at a time, by packets or by the scalar reference.
/// `Real` is float, double or long double. Throws as render() does. `scene` must outlive the
/// result.
template <class Real>
[[nodiscard]] RenderRows<Real> row_renderer(const Scene& scene, const RenderOptions& options);

}  // namespace packtrace
