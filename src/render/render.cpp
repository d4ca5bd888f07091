#include <packtrace/render.hpp>

#include <stdexcept>
#include <type_traits>

#include <packtrace/renderer.hpp>
#include <packtrace/validate.hpp>

#include "lower/most_light.hpp"
#include "reference/render_reference.hpp"
#include "render/check_sampling.hpp"

namespace packtrace {

namespace {

/// The reference knows nothing of lowering, which finds how much light there can be.
template <class Real>
Image<Real> render_scalar(const Scene& scene, const RenderOptions& options, CutRays* cut)
{
    validate(scene);
    (void)checked_region(options, scene);
    if (cut == nullptr || scene.min_weight <= 0.0) {
        if (cut != nullptr)
            *cut = {};
        return render_reference<Real>(scene, checked_sampling(options));
    }
    const std::vector<Rgb> light = most_light(lower(scene));
    reference::CutCounter cuts(light);
    Image<Real> image = render_reference<Real>(scene, checked_sampling(options), &cuts);
    *cut = cuts.total();
    return image;
}

}  // namespace

template <class Real>
Image<Real> render(const Scene& scene, const RenderOptions& options, CutRays* cut)
{
    if (options.kernel == Kernel::scalar)
        return render_scalar<Real>(scene, options, cut);
    if constexpr (std::is_same_v<Real, long double>) {
        throw std::invalid_argument(
            "precision: packets come in single and double only; "
            "use the scalar kernel for extended");
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

}  // namespace packtrace
