#include "render/row_renderer.hpp"

#include <optional>
#include <stdexcept>
#include <type_traits>

#include <packtrace/validate.hpp>

#include "dispatch/kernels.hpp"
#include "lower/most_light.hpp"
#include "reference/render_reference.hpp"
#include "render/check_sampling.hpp"
#include "render/frame_renderer.hpp"

namespace packtrace {
namespace {

template <class Real>
constexpr bool has_packets = !std::is_same_v<Real, long double>;

/// Rows by the scalar reference.
template <class Real>
class ScalarRows {
public:
    ScalarRows(const Scene& scene, const RenderOptions& options)
        : height_(checked(scene).height),
          options_(checked_sampling(options)),
          reference_(scene, {}, options.self_hits)
    {
        // The reference knows nothing of lowering, which finds how much light there can be.
        if (scene.min_weight > 0.0)
            light_ = most_light(lower(scene));
    }

    FrameCounts render(int first, Image<Real>& image) const
    {
        FrameCounts counts;
        if (!light_) {
            render_reference_rows(reference_, height_, options_, first, image);
            return counts;
        }
        reference::CutCounter cuts(*light_);
        render_reference_rows(reference_, height_, options_, first, image, &cuts);
        counts.cut = cuts.total();
        return counts;
    }

private:
    static const Scene& checked(const Scene& scene)
    {
        validate(scene);
        return scene;
    }

    int height_;
    RenderOptions options_;
    reference::Reference<Real> reference_;
    std::optional<std::vector<Rgb>> light_;
};

template <class Real>
std::unique_ptr<FrameRenderer<Real>> packet_rows(const Scene& scene, const RenderOptions& options)
{
    const IsaInfo isa = choose_isa(options.isa, options.width);
    return std::make_unique<FrameRenderer<Real>>(
        scene, lower(scene, accuracy_in<Real>(options), options.self_hits), kernels_of(isa.name),
        options);
}

/// Stands where there are no packets.
struct NoPackets {
    template <class Real>
    FrameCounts render_rows(int, Image<Real>&) const
    {
        return {};
    }
};

}  // namespace

template <class Real>
struct RowRenderer<Real>::State {
    using Packets = std::conditional_t<has_packets<Real>, FrameRenderer<Real>, NoPackets>;

    std::unique_ptr<Packets> packets;
    std::unique_ptr<ScalarRows<Real>> scalar;
};

template <class Real>
RowRenderer<Real>::RowRenderer(const Scene& scene, const RenderOptions& options)
    : state_(std::make_unique<State>())
{
    if (options.kernel == Kernel::scalar)
        state_->scalar = std::make_unique<ScalarRows<Real>>(scene, options);
    else if constexpr (has_packets<Real>)
        state_->packets = packet_rows<Real>(scene, options);
    else
        throw std::invalid_argument(
            "precision: packets come in single and double only; "
            "use the scalar kernel for extended");
}

template <class Real>
RowRenderer<Real>::~RowRenderer() = default;

template <class Real>
FrameCounts RowRenderer<Real>::render(int first, Image<Real>& image) const
{
    return state_->packets ? state_->packets->render_rows(first, image)
                           : state_->scalar->render(first, image);
}

template class RowRenderer<float>;
template class RowRenderer<double>;
template class RowRenderer<long double>;

}  // namespace packtrace
