#include "cli/render/render_picture.hpp"

#include "core/text.hpp"
#include "render/precision.hpp"
#include "scene/language/numbers.hpp"
#include "scene/language/quote.hpp"

#include <cmath>
#include <iostream>
#include <new>
#include <stdexcept>

namespace packtrace::cli {
namespace {

/// The number with three digits, rounded up.
std::string rounded_up(double number)
{
    if (number == 0.0)
        return "0";
    const double unit = std::pow(10.0, std::floor(std::log10(number)) - 2.0);
    return brief(unit * std::ceil(number / unit));
}

/// Reports a lack of memory. The message has the memory of a large picture.
[[noreturn]] void fail_for_memory(int width, int height, Precision precision)
{
    // A smaller picture is not the reason for a lack of memory.
    constexpr double large = 1e8;
    const double bytes =
        with_real(precision, [&]<class Real>() { return 3.0 * sizeof(Real) * width * height; });
    if (bytes < large)
        throw std::bad_alloc();
    throw std::runtime_error("not enough memory for " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels, which alone take " +
                             gigabytes(bytes) + "; render fewer pixels at once");
}

}  // namespace

std::string gigabytes(double bytes)
{
    return fixed(1e-9 * bytes, 1) + " GB";
}

AnyImage render_picture(const Scene& scene, Precision precision, const RenderOptions& options,
                        CutRays* cut)
{
    try {
        return with_real(
            precision, [&]<class Real>() -> AnyImage { return render<Real>(scene, options, cut); });
    } catch (const std::bad_alloc&) {
        const Region part = options.region.value_or(Region{0, 0, scene.width, scene.height});
        fail_for_memory(part.width, part.height, precision);
    }
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
