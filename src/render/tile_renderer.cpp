#include "render/tile_renderer.hpp"

#include <algorithm>
#include <stdexcept>

#include "dispatch/kernels.hpp"
#include "lower/leave_out.hpp"
#include "render/camera_view.hpp"
#include "render/sample_batch.hpp"
#include "scene/sample_pattern.hpp"

namespace packtrace {
namespace {

Vec2 only_sample(const Scene& scene, const RenderOptions& options)
{
    return options.samples > 1 ? Vec2(0.5) : scene.camera.pixel_sample;
}

/// Leaves out what the picture does not need, or puts in all there is.
const LoweredScene& fitted(LoweredScene& lowered, const RenderOptions& options)
{
    if (!options.force_general)
        leave_out(lowered);
    else if (!lowered.features.probe)
        lowered.features =
            abi::with_exact(abi::feature_sets[abi::general_set].features, lowered.features.exact);
    return lowered;
}

/// What the tiles of a frame share that are traced in registers.
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

}  // namespace

template <class Real>
TileRenderer<Real>::TileRenderer(const Scene& scene, LoweredScene lowered,
                                 const abi::KernelTable& table, const RenderOptions& options)
    : width_(scene.width),
      height_(scene.height),
      kernels_(kernels_for(precision<Real>(table), fitted(lowered, options).features)),
      packed_(lowered, frame_traversal(lowered, options.traversal, precision<Real>(table).lanes)),
      pattern_(sample_pattern(options.samples)),
      once_(camera_view<Real>(scene, lowered, only_sample(scene, options))),
      corner_(camera_view<Real>(scene, lowered, Vec2(0.0))),
      fused_(fused_for(precision<Real>(table), lowered.features, packed_.view())),
      plan_(make_plan(fused_, packed_.view(), once_)),
      render_tile_(fused_ != nullptr ? fused_->render_tile : kernels_.render_tile),
      scratch_bytes_(fused_ != nullptr ? fused_->scratch_bytes(packed_.view())
                                       : kernels_.scratch_bytes(packed_.view())),
      scratch_([this] { return AlignedArray<std::byte>(scratch_bytes_); })
{
    packed_.add_light_buffers(lowered,
                              static_cast<double>(scene.width) * scene.height * options.samples);
}

template <class Real>
abi::TileJob<Real> TileRenderer<Real>::job_at(const abi::CameraView<Real>& camera, int x, int y,
                                              abi::Observation* observation) const
{
    abi::TileJob<Real> job;
    job.scene = &packed_.view();
    job.camera = &camera;
    job.x = x;
    job.y = y;
    job.width = std::min(abi::tile_size, width_ - x);
    job.height = std::min(abi::tile_size, height_ - y);
    job.scratch = scratch_.local().data();
    job.plan = plan_.data();
    job.observation = observation;
    return job;
}

template <class Real>
abi::RayCounts TileRenderer<Real>::render_once(const Canvas<Real>& canvas, int x, int y) const
{
    return render_once(canvas, x, y, observation_);
}

template <class Real>
abi::RayCounts TileRenderer<Real>::render_mean(const Canvas<Real>& canvas, int x, int y) const
{
    return render_mean(canvas, x, y, observation_);
}

template <class Real>
abi::RayCounts TileRenderer<Real>::render_observed(const Canvas<Real>& canvas, int x, int y,
                                                   abi::Observation& observation) const
{
    return pattern_.size() > 1 ? render_mean(canvas, x, y, &observation)
                               : render_once(canvas, x, y, &observation);
}

template <class Real>
abi::RayCounts TileRenderer<Real>::render_once(const Canvas<Real>& canvas, int x, int y,
                                               abi::Observation* observation) const
{
    abi::TileJob<Real> job = job_at(once_, x, y, observation);
    job.rgb = canvas.pixel(x, y);
    job.row_stride = std::ptrdiff_t{3} * canvas.image.width;
    return render_tile_(job);
}

// One sample of all pixels after the other, so that packets are as compact as with one sample.
template <class Real>
abi::RayCounts TileRenderer<Real>::render_mean(const Canvas<Real>& canvas, int x, int y,
                                               abi::Observation* observation) const
{
    constexpr int row_length = 3 * abi::tile_size;
    Real sums[row_length * abi::tile_size] = {};
    Real sample[row_length * abi::tile_size] = {};
    abi::CameraView<Real> camera = corner_;
    abi::TileJob<Real> job = job_at(camera, x, y, observation);
    job.rgb = sample;
    job.row_stride = row_length;
    abi::RayCounts counts;
    for (const Vec2& place : pattern_) {
        camera.first_x = corner_.first_x + static_cast<Real>(place.x);
        camera.first_y = corner_.first_y - static_cast<Real>(place.y);
        counts += render_tile_(job);
        for (int i = 0; i < row_length * abi::tile_size; ++i)
            sums[i] += sample[i];
    }
    const Real share = Real(1) / static_cast<Real>(pattern_.size());
    for (int row = 0; row < job.height; ++row)
        for (int i = 0; i < 3 * job.width; ++i)
            canvas.pixel(x, y + row)[i] = share * sums[row * row_length + i];
    return counts;
}

template <class Real>
abi::RayCounts TileRenderer<Real>::refine(const Canvas<Real>& canvas,
                                          const ContrastMap<Real>& contrast, int x, int y) const
{
    abi::TileJob<Real> job = job_at(corner_, x, y, observation_);
    abi::RayCounts counts;
    SampleBatch<Real> batch(pattern_, [&](const abi::TileSamples<Real>& samples, Real* rgb) {
        job.samples = &samples;
        job.rgb = rgb;
        counts += render_tile_(job);
    });
    for (int number = 0; number < abi::tile_pixels; ++number) {
        const auto [column, row] = z_order_place(number);
        if (column < job.width && row < job.height &&
            contrast(x + column - canvas.first_column, y + row - canvas.first_row))
            batch.add_pixel(column, row, canvas.pixel(x + column, y + row));
    }
    batch.finish();
    return counts;
}

template class TileRenderer<float>;
template class TileRenderer<double>;

}  // namespace packtrace
