#include "cli/render_picture.hpp"

#include <type_traits>

namespace packtrace::cli {
namespace {

template <class Real>
Image<float> render_as(const Scene& scene, const RenderOptions& options)
{
    if constexpr (std::is_same_v<Real, float>)
        return render<float>(scene, options);
    else
        return convert<float>(render<Real>(scene, options));
}

}  // namespace

Image<float> render_picture(const Scene& scene, const std::string& precision,
                            const RenderOptions& options)
{
    if (precision == "double")
        return render_as<double>(scene, options);
    if (precision == "extended")
        return render_as<long double>(scene, options);
    return render_as<float>(scene, options);
}

}  // namespace packtrace::cli
