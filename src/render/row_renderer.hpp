#pragma once

#include <functional>

#include <packtrace/renderer.hpp>

namespace packtrace {

/// A scene made ready to be rendered some rows at a time, by packets or by the scalar reference.
/// `Real` is float, double or long double.
template <class Real>
class RowRenderer {
public:
    /// Throws as render() does. `scene` has to outlive it.
    RowRenderer(const Scene& scene, const RenderOptions& options);

    /// Renders the rows of `image`, the first of which is row `first` of the picture, to the bits
    /// they have in the whole picture. Rows are whole tiles, as for FrameRenderer. Rays are counted
    /// of packets alone, those that are cut always.
    FrameCounts render(int first, Image<Real>& image) const
    {
        return render_(first, image);
    }

private:
    std::function<FrameCounts(int first, Image<Real>& image)> render_;
};

}  // namespace packtrace
