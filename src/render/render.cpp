#include "dispatch/kernels.hpp"
#include "lower/lowered_scene.hpp"
#include "reference/render_reference.hpp"
#include "render/check_options.hpp"
#include "render/frame_renderer.hpp"
#include "render/row_renderer.hpp"
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>
#include <packtrace/validate.hpp>

#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

// The ways to render pictures: render() for one picture, Renderer for many pictures of one scene,
// row_renderer() for some rows at a time.
namespace packtrace {
namespace {

template <class Real>
constexpr bool has_packets = !std::is_same_v<Real, long double>;

[[noreturn]] void refuse_packets()
{
    throw std::invalid_argument(
        "precision: packets come in single and double only; "
        "use the scalar kernel for extended");
}

/// The reference does not lower scenes. Only the bound of cut rays needs a lowered scene, which
/// knows the largest possible light.
template <class Real>
Image<Real> render_scalar(const Scene& scene, const RenderOptions& options, CutRays* cut)
{
    validate(scene);
    (void)checked_region(options, scene);
    if (cut == nullptr || scene.min_weight <= 0.0) {
        if (cut != nullptr)
            *cut = {};
        return render_reference<Real>(scene, checked_options(options));
    }
    const std::vector<Rgb> light = most_light(lower(scene));
    reference::CutCounter cuts(light);
    Image<Real> image = render_reference<Real>(scene, checked_options(options), &cuts);
    *cut = cuts.total();
    return image;
}

/// Renders rows with the scalar reference. Cut rays are bounded as in render_scalar().
template <class Real>
class ScalarRows {
public:
    ScalarRows(const Scene& scene, const RenderOptions& options)
        : height_(checked(scene).height),
          options_(checked_options(options)),
          reference_(scene, {}, options.self_hits)
    {
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
std::shared_ptr<FrameRenderer<Real>> packet_rows(const Scene& scene, const RenderOptions& options)
{
    const IsaInfo isa = choose_isa(options.isa, options.width);
    return std::make_shared<FrameRenderer<Real>>(scene, lower_for<Real>(scene, options),
                                                 kernels_of(isa.name), options);
}

}  // namespace

template <class Real>
struct Renderer<Real>::State {
    IsaInfo isa;
    FrameRenderer<Real> frames;

    State(const Scene& scene, const RenderOptions& options)
        : isa(choose_isa(options.isa, options.width)),
          frames(scene, lower_for<Real>(scene, options), kernels_of(isa.name), options)
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

template <class Real>
Image<Real> render(const Scene& scene, const RenderOptions& options, CutRays* cut)
{
    if (options.kernel == Kernel::scalar)
        return render_scalar<Real>(scene, options, cut);
    if constexpr (!has_packets<Real>) {
        refuse_packets();
    } else {
        Image<Real> image;
        const FrameCounts counts = Renderer<Real>(scene, options).render(image);
        if (cut != nullptr)
            *cut = counts.cut;
        return image;
    }
}

template Image<float> render(const Scene&, const RenderOptions&, CutRays*);
template Image<double> render(const Scene&, const RenderOptions&, CutRays*);
template Image<long double> render(const Scene&, const RenderOptions&, CutRays*);

template <class Real>
RenderRows<Real> row_renderer(const Scene& scene, const RenderOptions& options)
{
    if (options.kernel == Kernel::scalar) {
        const auto rows = std::make_shared<ScalarRows<Real>>(scene, options);
        return [rows](int first, Image<Real>& image) { return rows->render(first, image); };
    }
    if constexpr (has_packets<Real>) {
        const auto rows = packet_rows<Real>(scene, options);
        return [rows](int first, Image<Real>& image) { return rows->render_rows(first, image); };
    } else {
        refuse_packets();
    }
}

template RenderRows<float> row_renderer(const Scene&, const RenderOptions&);
template RenderRows<double> row_renderer(const Scene&, const RenderOptions&);
template RenderRows<long double> row_renderer(const Scene&, const RenderOptions&);

}  // namespace packtrace
