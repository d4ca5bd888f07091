#include "render/frame_renderer.hpp"

#include <algorithm>
#include <utility>

#include <tbb/task_arena.h>

#include "render/check_sampling.hpp"

namespace packtrace {
namespace {

FrameCounts operator+(const FrameCounts& a, const FrameCounts& b)
{
    return {
        a.camera + b.camera,       a.shadow + b.shadow,
        a.reflected + b.reflected, a.refracted + b.refracted,
        a.unsure + b.unsure,       {a.cut.rays + b.cut.rays, std::max(a.cut.bound, b.cut.bound)}};
}

}  // namespace

template <class Real>
FrameRenderer<Real>::FrameRenderer(const Scene& scene, LoweredScene lowered,
                                   const abi::KernelTable& table, const RenderOptions& options)
    : width_(scene.width),
      height_(scene.height),
      options_(options),
      tiles_(scene, std::move(lowered), table, checked_sampling(options))
{
}

template <class Real>
FrameCounts FrameRenderer<Real>::render_tiles(int first, Image<Real>& image) const
{
    if (options_.adaptive)
        return render_adaptive(first, image);
    const TileGrid grid(width_, image.height, first);
    const Canvas<Real> canvas(image, first);
    Progress done(grid.count, options_.progress);
    return for_each_tile(grid, done, [&](int x, int y) {
        return options_.samples > 1 ? tiles_.render_mean(canvas, x, y)
                                    : tiles_.render_once(canvas, x, y);
    });
}

// All tiles once, then the pixels with contrast in full. Contrast also looks at the rows beside
// those asked for: a tile more on either side.
template <class Real>
FrameCounts FrameRenderer<Real>::render_adaptive(int first, Image<Real>& image) const
{
    const int end = first + image.height;
    const int above = std::min(first, abi::tile_size);
    const int below = std::min(height_ - end, abi::tile_size);
    Image<Real> wider;
    if (above + below > 0)
        wider = Image<Real>::unset(width_, above + image.height + below);
    Image<Real>& all = above + below > 0 ? wider : image;
    const Canvas<Real> canvas(all, first - above);
    const TileGrid grid(width_, image.height, first);
    const TileGrid around(width_, all.height, first - above);
    Progress done(around.count + grid.count, options_.progress);
    const FrameCounts once = for_each_tile(around, done, [&](int x, int y) {
        const abi::RayCounts counts = tiles_.render_once(canvas, x, y);
        return y >= first && y < end ? counts : abi::RayCounts();
    });
    ContrastMap<Real> contrast(all, *options_.adaptive);
    tbb::parallel_for(0, all.height, [&](int row) { contrast.mark_row(row); });
    const FrameCounts more = for_each_tile(
        grid, done, [&](int x, int y) { return tiles_.refine(canvas, contrast, x, y); });
    if (above + below > 0)
        std::copy_n(all.pixel(0, above), image.rgb.size(), image.rgb.begin());
    return once + more;
}

template <class Real>
FrameCounts FrameRenderer<Real>::render(Image<Real>& image) const
{
    if (image.width != width_ || image.height != height_)
        image = Image<Real>::unset(width_, height_);
    return render_rows(0, image);
}

template <class Real>
FrameCounts FrameRenderer<Real>::render_rows(int first, Image<Real>& image) const
{
    if (options_.threads == 0)
        return render_tiles(first, image);
    tbb::task_arena arena(options_.threads);
    return arena.execute([&] { return render_tiles(first, image); });
}

template class FrameRenderer<float>;
template class FrameRenderer<double>;

}  // namespace packtrace
