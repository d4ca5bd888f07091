#include "render/frame_renderer.hpp"

#include "core/arena.hpp"
#include "core/cut_rays.hpp"
#include "image/contrast.hpp"
#include "render/check_options.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace packtrace {
namespace {

FrameCounts operator+(FrameCounts a, const FrameCounts& b)
{
    return {a.camera + b.camera,       a.shadow + b.shadow, a.reflected + b.reflected,
            a.refracted + b.refracted, a.unsure + b.unsure, a.cut += b.cut};
}

}  // namespace

template <class Real>
FrameRenderer<Real>::FrameRenderer(const Scene& scene, LoweredScene lowered,
                                   const abi::KernelTable& table, const RenderOptions& options)
    : width_(scene.width),
      height_(scene.height),
      region_(checked_region(options, scene)),
      options_(options),
      tiles_(scene, std::move(lowered), table, checked_options(options))
{
}

/// The tiles that overlap the region.
template <class Real>
Region FrameRenderer<Real>::whole_tiles(const Region& region) const
{
    const auto down = [](int pixel) { return pixel / abi::tile_size * abi::tile_size; };
    const auto up = [&](int pixel) { return down(pixel + abi::tile_size - 1); };
    const int x = down(region.x);
    const int y = down(region.y);
    return {x, y, std::min(width_, up(region.x + region.width)) - x,
            std::min(height_, up(region.y + region.height)) - y};
}

template <class Real>
TileGrid FrameRenderer<Real>::blocks_of(const Region& region) const
{
    return TileGrid(region, tiles_.block_edge(region, tbb::this_task_arena::max_concurrency()));
}

/// `image` has the size of `tiles`.
template <class Real>
FrameCounts FrameRenderer<Real>::render_tiles(const Region& tiles, Image<Real>& image) const
{
    const TileGrid grid = blocks_of(tiles);
    const Canvas<Real> canvas(image, tiles.x, tiles.y);
    Progress done(grid.count(), options_.progress, options_.stop);
    return for_each_piece(grid, done,
                          [&](const Region& piece) { return tiles_.render(canvas, piece); });
}

/// Renders the tiles `around` with one sample per pixel, then the pixels of `tiles` with contrast
/// with all samples. `image` has the size of `around`.
template <class Real>
FrameCounts FrameRenderer<Real>::render_adaptive(const Region& tiles, const Region& around,
                                                 Image<Real>& image) const
{
    const Canvas<Real> canvas(image, around.x, around.y);
    // Rays of tiles that are only in `around` are not counted: they belong to another region.
    const TileGrid all = tiles == around ? blocks_of(around) : TileGrid(around);
    const TileGrid grid(tiles);
    Progress done(all.count() + grid.count(), options_.progress, options_.stop);
    const FrameCounts once = for_each_piece(all, done, [&](const Region& piece) {
        const abi::RayCounts counts = tiles_.render_once(canvas, piece);
        return tiles.contains(piece.x, piece.y) ? counts : abi::RayCounts();
    });
    ContrastMap<Real> contrast(image, *options_.adaptive);
    tbb::parallel_for(0, image.height, [&](int row) { contrast.mark_row(row); });
    return once + for_each_piece(grid, done, [&](const Region& tile) {
               return tiles_.refine(canvas, contrast, tile);
           });
}

template <class Real>
FrameCounts FrameRenderer<Real>::render_region(const Region& region, Image<Real>& image) const
{
    const Region tiles = whole_tiles(region);
    const Region held =
        options_.adaptive ? whole_tiles(with_neighbours(tiles, width_, height_)) : tiles;
    Image<Real> larger;
    if (held != region)
        larger = Image<Real>::unset(held.width, held.height);
    Image<Real>& all = held != region ? larger : image;
    tiles_.expect(static_cast<double>(region.width) * region.height * options_.samples);
    const FrameCounts counts =
        options_.adaptive ? render_adaptive(tiles, held, all) : render_tiles(tiles, all);
    if (held != region)
        copy_region({region.x - held.x, region.y - held.y, region.width, region.height}, larger,
                    image);
    return counts;
}

template <class Real>
FrameCounts FrameRenderer<Real>::render(Image<Real>& image) const
{
    // is_whole(): an image whose pixels were moved away keeps its width and height.
    if (image.width != region_.width || image.height != region_.height || !image.is_whole())
        image = Image<Real>::unset(region_.width, region_.height);
    return run_on_threads(options_.threads, [&] { return render_region(region_, image); });
}

template <class Real>
FrameCounts FrameRenderer<Real>::render_rows(int first, Image<Real>& image) const
{
    const Region rows{0, first, width_, image.height};
    return run_on_threads(options_.threads, [&] { return render_region(rows, image); });
}

template class FrameRenderer<float>;
template class FrameRenderer<double>;

}  // namespace packtrace
