#include "lower/buffered_scene.hpp"

#include <tbb/parallel_for.h>

#include <limits>

namespace packtrace {
namespace {

/// The share of shadow rays from camera rays' hits that are spread, roughly. Shadow rays from the
/// hits of mirrored rays all are.
constexpr double spread_share_of_camera_rays = 0.05;

}  // namespace

template <class Real>
double camera_rays_for_buffers(const PackedScene<Real>& scene, bool bounces)
{
    if (scene.view().lighting.transparent_shadows)
        return std::numeric_limits<double>::infinity();
    return scene.casters().rays_for_light_buffer() / (bounces ? 1.0 : spread_share_of_camera_rays);
}

template <class Real>
BufferedScene<Real>::BufferedScene(const PackedScene<Real>& scene) : view_(scene.view())
{
    const PackedScene<Real>& casters = scene.casters();
    const auto& lights = view_.lighting.lights;
    buffers_.resize(static_cast<std::size_t>(lights.count));
    buffer_views_ = AlignedArray<abi::LightBuffer>(buffers_.size());
    tbb::parallel_for(std::size_t{0}, buffers_.size(), [&](std::size_t light) {
        if (!lights.data[light].casts_shadow)
            return;
        buffers_[light] = casters.light_buffer(lights.data[light]);
        buffer_views_[light] = buffers_[light].view();
    });
    if (view_.casters == nullptr) {
        view_.lighting.buffers = buffer_views_.data();
        return;
    }
    casters_ = *view_.casters;
    casters_.lighting.buffers = buffer_views_.data();
    view_.casters = &casters_;
}

template <class Real>
std::size_t BufferedScene<Real>::bytes() const
{
    std::size_t bytes = sizeof *this + buffer_views_.bytes();
    for (const PackedLightBuffer& buffer : buffers_)
        bytes += buffer.bytes();
    return bytes;
}

template double camera_rays_for_buffers(const PackedScene<float>&, bool);
template double camera_rays_for_buffers(const PackedScene<double>&, bool);
template class BufferedScene<float>;
template class BufferedScene<double>;

}  // namespace packtrace
