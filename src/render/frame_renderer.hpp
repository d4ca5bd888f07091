#pragma once

#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include <packtrace/renderer.hpp>

namespace packtrace {

/// Renders pictures of a lowered scene with the kernels of any table. It implements Renderer.
template <class Real>
class FrameRenderer {
public:
    /// Uses the options for threads, sampling, traversal, progress, stop, region and force_general.
    /// Throws std::invalid_argument for impossible ones.
    FrameRenderer(const Scene& scene, LoweredScene lowered, const abi::KernelTable& table,
                  const RenderOptions& options);

    /// As Renderer::render().
    FrameCounts render(Image<Real>& image) const;

    /// Renders only the rows of `image`; its first row is row `first` of the picture. The rows
    /// equal those of the whole picture, bit for bit. Counts are those of these rows. Rows must be
    /// whole tiles: `first` is a multiple of a tile's size, and so is the number of rows, except at
    /// the picture's end.
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
