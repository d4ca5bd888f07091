#include <packtrace/renderer.hpp>

#include "dispatch/kernels.hpp"
#include "render/frame_renderer.hpp"

namespace packtrace {

template <class Real>
struct Renderer<Real>::State {
    IsaInfo isa;
    FrameRenderer<Real> frames;

    State(const Scene& scene, const RenderOptions& options)
        : isa(choose_isa(options.isa, options.width)),
          frames(scene, lower(scene, accuracy_in<Real>(options), options.self_hits),
                 kernels_of(isa.name), options)
    {
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
    return state_->frames.render(image);
}

template <class Real>
std::size_t Renderer<Real>::scene_bytes() const
{
    return state_->frames.scene_bytes();
}

template <class Real>
const IsaInfo& Renderer<Real>::isa() const
{
    return state_->isa;
}

template class Renderer<float>;
template class Renderer<double>;

}  // namespace packtrace
