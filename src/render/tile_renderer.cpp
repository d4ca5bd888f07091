#include "render/tile_renderer.hpp"

#include "dispatch/kernels.hpp"
#include "lower/prune.hpp"
#include "render/camera_view.hpp"
#include "render/sample_batch.hpp"
#include "render/tile_loop.hpp"
#include "scene/sample_pattern.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace packtrace {
namespace {

Vec2 only_sample(const Scene& scene, const RenderOptions& options)
{
    return options.samples > 1 ? Vec2(0.5) : scene.camera.pixel_sample;
}

/// Prunes the scene. With force_general it is not pruned, and gets all features instead.
LoweredScene fit(LoweredScene lowered, const RenderOptions& options)
{
    if (!options.force_general)
        prune(lowered);
    else if (!lowered.features.probe)
        lowered.features =
            abi::with_exact(abi::feature_sets[abi::general_set].features, lowered.features.exact);
    return lowered;
}

/// The data that the fused kernels compute once for all tiles of a frame.
template <class Real>
AlignedArray<std::byte> make_plan(const abi::FusedKernels<Real>* fused,
                                  const abi::SceneView<Real>& scene,
                                  const abi::CameraView<Real>& camera)
{
    if (fused == nullptr)
        return {};
    AlignedArray<std::byte> plan(fused->plan_bytes(scene));
    fused->make_plan(scene, camera, plan.data());
    return plan;
}

/// Blocks per thread, so many that no thread works alone for long at the end of a frame.
constexpr int blocks_of_a_thread = 16;

/// The largest number of tiles that are rendered together.
int tiles_together(const Scene& scene, bool sorts_mirrored)
{
    const TileGrid picture({0, 0, scene.width, scene.height});
    return sorts_mirrored ? std::min(abi::block_tiles, picture.count()) : 1;
}

}  // namespace

template <class Real>
TileRenderer<Real>::TileRenderer(const Scene& scene, LoweredScene lowered,
                                 const abi::KernelTable& table, const RenderOptions& options)
    : TileRenderer(scene, Fitted{fit(std::move(lowered), options)}, table, options)
{
}

template <class Real>
TileRenderer<Real>::TileRenderer(const Scene& scene, const Fitted& fitted,
                                 const abi::KernelTable& table, const RenderOptions& options)
    : kernels_(kernels_for(precision<Real>(table), fitted.scene.features)),
      packed_(fitted.scene,
              frame_traversal(fitted.scene, options.traversal, precision<Real>(table).lanes)),
      rays_for_buffers_(camera_rays_for_buffers(packed_, fitted.scene.bounces)),
      pattern_(sample_pattern(options.samples)),
      once_(camera_view<Real>(scene, fitted.scene, only_sample(scene, options))),
      corner_(camera_view<Real>(scene, fitted.scene, Vec2(0.0))),
      fused_(fused_for(precision<Real>(table), fitted.scene.features, packed_.view())),
      plan_(make_plan(fused_, packed_.view(), once_)),
      render_tiles_(fused_ != nullptr ? fused_->render_tiles : kernels_.render_tiles),
      sorts_mirrored_(sorts_mirrored(fitted.scene.features, packed_.view())),
      scratch_bytes_(
          fused_ != nullptr
              ? fused_->scratch_bytes(packed_.view())
              : kernels_.scratch_bytes(packed_.view(), tiles_together(scene, sorts_mirrored_))),
      scratch_([this] { return AlignedArray<std::byte>(scratch_bytes_); })
{
    const double frame = static_cast<double>(scene.width) * scene.height * options.samples;
    if (frame >= rays_for_buffers_)
        expect(frame);
}

template <class Real>
void TileRenderer<Real>::expect(double camera_rays) const
{
    buffered_.after(camera_rays, rays_for_buffers_,
                    [&] { return std::make_unique<BufferedScene<Real>>(packed_); });
}

template <class Real>
const abi::SceneView<Real>& TileRenderer<Real>::view() const
{
    const BufferedScene<Real>* const buffered = buffered_.get();
    return buffered != nullptr ? buffered->view() : packed_.view();
}

template <class Real>
int TileRenderer<Real>::block_edge(const Region& region, int threads) const
{
    constexpr int large = abi::block_edge * abi::tile_size;
    constexpr int small = large / 2;
    if (!sorts_mirrored_)
        return abi::tile_size;
    if (threads == 1)
        return large;
    for (const int edge : {large, small})
        if (TileGrid(region, edge).count() >= blocks_of_a_thread * threads)
            return edge;
    return abi::tile_size;
}

template <class Real>
abi::TileJob<Real> TileRenderer<Real>::job_of(const abi::CameraView<Real>& camera,
                                              const Region& tile,
                                              abi::Observation* observation) const
{
    return {.scene = &view(),
            .camera = &camera,
            .x = tile.x,
            .y = tile.y,
            .width = tile.width,
            .height = tile.height,
            .scratch = scratch_.local().data(),
            .plan = plan_.data(),
            .observation = observation};
}

template <class Real>
abi::RayCounts TileRenderer<Real>::render_piece(const abi::CameraView<Real>& camera,
                                                const Region& piece, const Pixels& pixels,
                                                abi::Observation* observation) const
{
    abi::TileJob<Real> job = job_of(camera, piece, observation);
    job.rgb = pixels.first;
    job.row_stride = pixels.row_stride;
    if (piece.width <= abi::tile_size && piece.height <= abi::tile_size)
        return render_tiles_(&job, 1);
    const TileGrid tiles(piece);
    std::vector<abi::TileJob<Real>> jobs(static_cast<std::size_t>(tiles.count()), job);
    for (int i = 0; i < tiles.count(); ++i) {
        const Region tile = tiles[i];
        abi::TileJob<Real>& part = jobs[static_cast<std::size_t>(i)];
        part.x = tile.x;
        part.y = tile.y;
        part.width = tile.width;
        part.height = tile.height;
        part.rgb += (tile.y - piece.y) * pixels.row_stride + 3 * (tile.x - piece.x);
    }
    return render_tiles_(jobs.data(), tiles.count());
}

template <class Real>
abi::RayCounts TileRenderer<Real>::render(const Canvas<Real>& canvas, const Region& piece,
                                          abi::Observation* observation) const
{
    if (pattern_.size() > 1)
        return render_mean(canvas, piece, observation);
    return render_once(canvas, piece, observation);
}

template <class Real>
abi::RayCounts TileRenderer<Real>::render_once(const Canvas<Real>& canvas, const Region& piece,
                                               abi::Observation* observation) const
{
    return render_piece(once_, piece,
                        {canvas.pixel(piece.x, piece.y), std::ptrdiff_t{3} * canvas.image.width},
                        observation);
}

// Renders one sample of all pixels, then the next, so that packets are as coherent as with one
// sample.
template <class Real>
abi::RayCounts TileRenderer<Real>::render_mean(const Canvas<Real>& canvas, const Region& piece,
                                               abi::Observation* observation) const
{
    const std::size_t row_length = 3 * static_cast<std::size_t>(piece.width);
    std::vector<Real> sums(row_length * static_cast<std::size_t>(piece.height));
    std::vector<Real> sample(sums.size());
    abi::CameraView<Real> camera = corner_;
    const Pixels pixels{sample.data(), static_cast<std::ptrdiff_t>(row_length)};
    abi::RayCounts counts;
    for (const Vec2& place : pattern_) {
        camera.first_x = corner_.first_x + static_cast<Real>(place.x);
        camera.first_y = corner_.first_y - static_cast<Real>(place.y);
        counts += render_piece(camera, piece, pixels, observation);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += sample[i];
    }
    const Real share = Real(1) / static_cast<Real>(pattern_.size());
    const Real* sum = sums.data();
    for (int row = 0; row < piece.height; ++row)
        for (int i = 0; i < 3 * piece.width; ++i)
            canvas.pixel(piece.x, piece.y + row)[i] = share * *sum++;
    return counts;
}

template <class Real>
abi::RayCounts TileRenderer<Real>::refine(const Canvas<Real>& canvas,
                                          const ContrastMap<Real>& contrast, const Region& tile,
                                          abi::Observation* observation) const
{
    abi::TileJob<Real> job = job_of(corner_, tile, observation);
    abi::RayCounts counts;
    SampleBatch<Real> batch(pattern_, [&](const abi::TileSamples<Real>& samples, Real* rgb) {
        job.samples = &samples;
        job.rgb = rgb;
        counts += render_tiles_(&job, 1);
    });
    for_each_pixel(tile, [&](int, int x, int y) {
        if (contrast(x - canvas.first_column, y - canvas.first_row))
            batch.add_pixel(x - tile.x, y - tile.y, canvas.pixel(x, y));
    });
    batch.finish();
    return counts;
}

template class TileRenderer<float>;
template class TileRenderer<double>;

}  // namespace packtrace
