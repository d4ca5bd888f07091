#pragma once

#include <packtrace/renderer.hpp>

#include <functional>

namespace packtrace {

/// Renders the rows of `image`, the first of which is row `first` of the picture, to the bits they
/// have in the whole picture. Rows are whole tiles, as for FrameRenderer. Rays are counted of
/// packets alone, those that are cut always.
template <class Real>
using RenderRows = std::function<FrameCounts(int first, Image<Real>& image)>;

/// A scene made ready to be rendered some rows at a time, by packets or by the scalar reference.
/// `Real` is float, double or long double. Throws as render() does. `scene` has to outlive it.
template <class Real>
[[nodiscard]] RenderRows<Real> row_renderer(const Scene& scene, const RenderOptions& options);

}  // namespace packtrace
