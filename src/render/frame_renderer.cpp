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
FrameCounts FrameRenderer<Real>::render_tiles(Image<Real>& image) const
{
    const TileGrid grid(width_, height_);
    if (options_.adaptive)
        return render_adaptive(grid, image);
    Progress done(grid.count, options_.progress);
    return for_each_tile(grid, done, [&](int x, int y) {
        return options_.samples > 1 ? tiles_.render_mean(image, x, y)
                                    : tiles_.render_once(image, x, y);
    });
}

// All tiles once, then the pixels with contrast in full.
template <class Real>
FrameCounts FrameRenderer<Real>::render_adaptive(const TileGrid& grid, Image<Real>& image) const
{
    Progress done(2 * grid.count, options_.progress);
    const FrameCounts first =
        for_each_tile(grid, done, [&](int x, int y) { return tiles_.render_once(image, x, y); });
    ContrastMap<Real> contrast(image, *options_.adaptive);
    tbb::parallel_for(0, height_, [&](int y) { contrast.mark_row(y); });
    return first + for_each_tile(grid, done, [&](int x, int y) {
               return tiles_.refine(image, contrast, x, y);
           });
}

template <class Real>
FrameCounts FrameRenderer<Real>::render(Image<Real>& image) const
{
    if (image.width != width_ || image.height != height_)
        image = Image<Real>::unset(width_, height_);
    if (options_.threads == 0)
        return render_tiles(image);
    tbb::task_arena arena(options_.threads);
    return arena.execute([&] { return render_tiles(image); });
}

template class FrameRenderer<float>;
template class FrameRenderer<double>;

}  // namespace packtrace
