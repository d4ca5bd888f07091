#include <packtrace/renderer.hpp>

#include <functional>

#include <tbb/task_arena.h>

#include "render/check_sampling.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"

namespace packtrace {
namespace {

FrameCounts operator+(const FrameCounts& a, const FrameCounts& b)
{
    return {a.camera + b.camera, a.shadow + b.shadow, a.reflected + b.reflected,
            a.refracted + b.refracted};
}

}  // namespace

template <class Real>
struct Renderer<Real>::State {
    int width;
    int height;
    RenderOptions options;
    TileRenderer<Real> tiles;

    State(const Scene& scene, const RenderOptions& options_)
        : width(scene.width),
          height(scene.height),
          options(options_),
          tiles(scene, checked_sampling(options_))
    {
    }

    [[nodiscard]] FrameCounts render_tiles(Image<Real>& image) const
    {
        const TileGrid grid(width, height);
        if (options.adaptive)
            return render_adaptive(grid, image);
        Progress done(grid.count, options.progress);
        return for_each_tile(grid, done, [&](int x, int y) {
            return options.samples > 1 ? tiles.render_mean(image, x, y)
                                       : tiles.render_once(image, x, y);
        });
    }

    // All tiles once, then the pixels with contrast in full.
    [[nodiscard]] FrameCounts render_adaptive(const TileGrid& grid, Image<Real>& image) const
    {
        Progress done(2 * grid.count, options.progress);
        const FrameCounts first =
            for_each_tile(grid, done, [&](int x, int y) { return tiles.render_once(image, x, y); });
        ContrastMap<Real> contrast(image, *options.adaptive);
        tbb::parallel_for(0, height, [&](int y) { contrast.mark_row(y); });
        return first + for_each_tile(grid, done, [&](int x, int y) {
                   return tiles.refine(image, contrast, x, y);
               });
    }
};

template <class Real>
Renderer<Real>::Renderer(const Scene& scene, const RenderOptions& options)
    : state_(std::make_unique<State>(scene, options))
{
}

template <class Real>
Renderer<Real>::~Renderer() = default;
template <class Real>
Renderer<Real>::Renderer(Renderer&&) noexcept = default;
template <class Real>
Renderer<Real>& Renderer<Real>::operator=(Renderer&&) noexcept = default;

template <class Real>
FrameCounts Renderer<Real>::render(Image<Real>& image) const
{
    if (image.width != state_->width || image.height != state_->height)
        image = Image<Real>(state_->width, state_->height);
    if (state_->options.threads == 0)
        return state_->render_tiles(image);
    tbb::task_arena arena(state_->options.threads);
    return arena.execute([&] { return state_->render_tiles(image); });
}

template <class Real>
const IsaInfo& Renderer<Real>::isa() const
{
    return state_->tiles.isa();
}

template class Renderer<float>;
template class Renderer<double>;

}  // namespace packtrace
