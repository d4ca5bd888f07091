#include "render/lit_scene.hpp"

#include <tbb/task_arena.h>

#include <cmath>

namespace packtrace {
namespace {

/// Lights all points except those with a NaN.
template <class Real>
void light_all(const abi::PointsView<Real>& points, std::uint8_t* mask)
{
    for (int i = 0; i < points.count; ++i)
        mask[i] = !std::isnan(points.point[0][i]) && !std::isnan(points.point[1][i]) &&
                  !std::isnan(points.point[2][i]);
}

}  // namespace

template <class Real>
LitScene<Real>::LitScene(const LoweredScene& lowered, const PackedScene<Real>& shapes,
                         Traversal traversal, const abi::PrecisionTable<Real>& kernels)
    : shapes_(shapes),
      traversal_(traversal),
      kernels_(kernels),
      buffers_(lowered.lights.size()),
      scratch_([this] { return AlignedArray<std::byte>::unset(scratch_bytes_); })
{
    if (!lowered.casts_shadow.empty() && lowered.shadows)
        lowered_casters_ = std::make_unique<LoweredScene>(shadow_casters(lowered));
}

template <class Real>
void LitScene<Real>::prepare()
{
    casters_ = &shapes_;
    view_ = shapes_.view();
    if (lowered_casters_ != nullptr) {
        // Isolated, so that no thread takes other work meanwhile, which might wait for this one.
        tbb::this_task_arena::isolate([&] {
            packed_casters_ = std::make_unique<PackedScene<Real>>(*lowered_casters_, traversal_);
        });
        lowered_casters_.reset();
        casters_ = packed_casters_.get();
        view_.casters = &packed_casters_->view();
    }
    scratch_bytes_ = kernels_.lit_scratch_bytes(view_);
}

template <class Real>
const abi::LightBuffer* LitScene<Real>::buffer_of(std::size_t light, std::size_t rays)
{
    const PackedLightBuffer* const buffer =
        buffers_[light].after(static_cast<double>(rays), casters_->rays_for_light_buffer(), [&] {
            return tbb::this_task_arena::isolate([&] {
                return std::make_unique<PackedLightBuffer>(
                    casters_->light_buffer(record_of(light)));
            });
        });
    return buffer != nullptr && buffer->view().cells != nullptr ? &buffer->view() : nullptr;
}

template <class Real>
void LitScene<Real>::lit(const abi::PointsView<Real>& points, std::size_t light, std::uint8_t* mask)
{
    if (!record_of(light).casts_shadow) {
        light_all(points, mask);
        return;
    }
    std::call_once(prepared_, [this] { prepare(); });
    const auto rays = static_cast<std::size_t>(points.count);
    kernels_.lit(view_, points, record_of(light), buffer_of(light, rays), mask,
                 scratch_.local().data());
}

template class LitScene<float>;
template class LitScene<double>;

}  // namespace packtrace
