#include "cli/render/render_picture.hpp"

namespace packtrace::cli {

AnyImage render_picture(const Scene& scene, const std::string& precision,
                        const RenderOptions& options, CutRays* cut)
{
    if (precision == "double")
        return render<double>(scene, options, cut);
    if (precision == "extended")
        return render<long double>(scene, options, cut);
    return render<float>(scene, options, cut);
}

void write_picture(const std::filesystem::path& file, const AnyImage& picture,
                   const ImageWriteOptions& options)
{
    std::visit([&](const auto& image) { write_image(file, image, options); }, picture);
}

}  // namespace packtrace::cli
