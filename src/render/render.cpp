#include <packtrace/render.hpp>

#include <stdexcept>
#include <type_traits>

#include <packtrace/renderer.hpp>

#include "lower/check_scene.hpp"
#include "reference/render_reference.hpp"
#include "render/check_sampling.hpp"

namespace packtrace {

template <class Real>
Image<Real> render(const Scene& scene, const RenderOptions& options)
{
    if (options.kernel == Kernel::scalar) {
        check_scene(scene);
        return render_reference<Real>(scene, checked_sampling(options));
    }
    if constexpr (std::is_same_v<Real, long double>) {
        throw std::invalid_argument(
            "precision: packets come in single and double only; "
            "use the scalar kernel for extended");
    } else {
        Image<Real> image;
        (void)Renderer<Real>(scene, options).render(image);
        return image;
    }
}

template Image<float> render(const Scene&, const RenderOptions&);
template Image<double> render(const Scene&, const RenderOptions&);
template Image<long double> render(const Scene&, const RenderOptions&);

}  // namespace packtrace
