#include "cli/render/render_picture.hpp"

#include "core/text.hpp"
#include "render/precision.hpp"
#include "scene/language/numbers.hpp"
#include "scene/language/quote.hpp"

#include <cmath>
#include <iostream>

namespace packtrace::cli {
namespace {

/// Three digits, never less than the number.
std::string rounded_up(double number)
{
    if (number == 0.0)
        return "0";
    const double unit = std::pow(10.0, std::floor(std::log10(number)) - 2.0);
    return brief(unit * std::ceil(number / unit));
}

}  // namespace

AnyImage render_picture(const Scene& scene, Precision precision, const RenderOptions& options,
                        CutRays* cut)
{
    return with_real(precision,
                     [&]<class Real>() -> AnyImage { return render<Real>(scene, options, cut); });
}

void write_picture(const std::filesystem::path& file, const AnyImage& picture,
                   const ImageWriteOptions& options)
{
    std::visit([&](const auto& image) { write_image(file, image, options); }, picture);
}

void print_cut_rays(const std::string& output, const Scene& scene, const RenderOptions& options,
                    const CutRays& cut)
{
    if (scene.min_weight <= 0.0)
        return;
    std::cerr << language::escape(output) << ": " << cut.rays << " rays of a weight below "
              << language::to_text(scene.min_weight) << " not traced; no pixel is off by more than "
              << rounded_up(cut.bound)
              << (options.adaptive ? " where the same samples are taken" : "") << '\n';
}

}  // namespace packtrace::cli
