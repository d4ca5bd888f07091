#pragma once

#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include <packtrace/renderer.hpp>

namespace packtrace {

/// Whole pictures of a lowered scene, with the kernels of any table: what Renderer is made of.
template <class Real>
class FrameRenderer {
public:
    /// Of the options threads, sampling, progress, stop and region count. Throws
    /// std::invalid_argument for impossible ones.
    FrameRenderer(const Scene& scene, LoweredScene lowered, const abi::KernelTable& table,
                  const RenderOptions& options);

    /// As Renderer::render.
    FrameCounts render(Image<Real>& image) const;

    /// Renders the rows of `image` alone, the first of which is row `first` of the picture. They
    /// have the bits they have in the whole picture; counts are of them alone. Rows are whole
    /// tiles: `first` is a multiple of a tile's size, and so is their number, but at the picture's
    /// end.
    FrameCounts render_rows(int first, Image<Real>& image) const;

    [[nodiscard]] std::size_t scene_bytes() const
    {
        return tiles_.scene_bytes();
    }

private:
    FrameCounts render_region(const Region& region, Image<Real>& image) const;
    [[nodiscard]] FrameCounts render_tiles(const Region& tiles, Image<Real>& image) const;
    [[nodiscard]] FrameCounts render_adaptive(const Region& tiles, const Region& around,
                                              Image<Real>& image) const;
    [[nodiscard]] Region whole_tiles(const Region& region) const;
    [[nodiscard]] TileGrid blocks_of(const Region& region) const;

    int width_;
    int height_;
    Region region_;
    RenderOptions options_;
    TileRenderer<Real> tiles_;
};

}  // namespace packtrace
