#include <packtrace/renderer.hpp>

#include <algorithm>
#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "lower/packed_scene.hpp"
#include "render/camera_view.hpp"
#include "render/progress.hpp"

namespace packtrace {

template <class Real>
struct Renderer<Real>::State {
    int width;
    int height;
    IsaInfo isa;
    LoweredScene lowered;
    const abi::FeatureKernels<Real>* kernels;
    PackedScene<Real> packed;
    abi::CameraView<Real> camera;
    int threads;
    std::function<void(double)> progress;
    std::size_t scratch_bytes;
    mutable tbb::enumerable_thread_specific<AlignedArray<std::byte>> scratch;

    State(const Scene& scene, const RenderOptions& options)
        : width(scene.width),
          height(scene.height),
          isa(choose_isa(options.isa, options.width)),
          lowered(lower(scene, accuracy_in<Real>(options), options.self_hits)),
          kernels(&kernels_for(precision<Real>(kernels_of(isa.name)), lowered.features)),
          packed(lowered, options.traversal),
          camera(camera_view<Real>(scene, lowered)),
          threads(options.threads),
          progress(options.progress),
          scratch_bytes(kernels->scratch_bytes(packed.view())),
          scratch([this] { return AlignedArray<std::byte>(scratch_bytes); })
    {
    }

    [[nodiscard]] abi::RayCounts render_tile(Image<Real>& image, int x, int y) const
    {
        abi::TileJob<Real> job;
        job.scene = &packed.view();
        job.camera = &camera;
        job.x = x;
        job.y = y;
        job.width = std::min(abi::tile_size, width - x);
        job.height = std::min(abi::tile_size, height - y);
        job.rgb = image.pixel(x, y);
        job.row_stride = std::ptrdiff_t{3} * width;
        job.scratch = scratch.local().data();
        return kernels->render_tile(job);
    }

    [[nodiscard]] FrameCounts render_tiles(Image<Real>& image) const
    {
        const int columns = (width + abi::tile_size - 1) / abi::tile_size;
        const int rows = (height + abi::tile_size - 1) / abi::tile_size;
        tbb::enumerable_thread_specific<FrameCounts> counts;
        Progress done(columns * rows, progress);
        tbb::parallel_for(
            tbb::blocked_range<int>(0, columns * rows, 1),
            [&](const tbb::blocked_range<int>& tiles) {
                FrameCounts& sum = counts.local();
                for (int tile = tiles.begin(); tile != tiles.end(); ++tile) {
                    const abi::RayCounts rays = render_tile(image, tile % columns * abi::tile_size,
                                                            tile / columns * abi::tile_size);
                    sum.camera += rays.camera;
                    sum.shadow += rays.shadow;
                    sum.reflected += rays.reflected;
                    sum.refracted += rays.refracted;
                    done.finish_piece();
                }
            },
            tbb::simple_partitioner());
        return counts.combine([](FrameCounts a, const FrameCounts& b) {
            a.camera += b.camera;
            a.shadow += b.shadow;
            a.reflected += b.reflected;
            a.refracted += b.refracted;
            return a;
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
    if (state_->threads == 0)
        return state_->render_tiles(image);
    tbb::task_arena arena(state_->threads);
    return arena.execute([&] { return state_->render_tiles(image); });
}

template <class Real>
const IsaInfo& Renderer<Real>::isa() const
{
    return state_->isa;
}

template class Renderer<float>;
template class Renderer<double>;

}  // namespace packtrace
