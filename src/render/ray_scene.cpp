#include <packtrace/intersect.hpp>

#include "lower/check_scene.hpp"
#include "render/ray_backend.hpp"

namespace packtrace {

template <class Real>
struct RayScene<Real>::State {
    std::unique_ptr<RayBackend<Real>> backend;
};

template <class Real>
RayScene<Real>::RayScene(const Scene& scene, const RenderOptions& options)
    : state_(std::make_unique<State>())
{
    if (options.kernel == Kernel::scalar) {
        check_scene(scene);
        state_->backend = scalar_backend<Real>(scene);
    } else {
        state_->backend = packet_backend<Real>(scene, options);
    }
}

template <class Real>
RayScene<Real>::~RayScene() = default;
template <class Real>
RayScene<Real>::RayScene(RayScene&&) noexcept = default;
template <class Real>
RayScene<Real>& RayScene<Real>::operator=(RayScene&&) noexcept = default;

template <class Real>
void RayScene<Real>::closest_hits(const RaysView<Real>& rays, const HitsView<Real>& hits) const
{
    state_->backend->closest_hits(rays, nullptr, hits);
}

template <class Real>
void RayScene<Real>::closest_hits(const RaysView<Real>& rays, const StartsView<Real>& starts,
                                  const HitsView<Real>& hits) const
{
    state_->backend->closest_hits(rays, &starts, hits);
}

template <class Real>
void RayScene<Real>::occluded(const RaysView<Real>& rays, std::uint8_t* mask) const
{
    state_->backend->occluded(rays, mask);
}

template <class Real>
void RayScene<Real>::all_hits(const RaysView<Real>& rays, const TakeHits& take) const
{
    state_->backend->all_hits(rays, take);
}

template class RayScene<float>;
template class RayScene<double>;

}  // namespace packtrace
