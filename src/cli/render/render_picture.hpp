#pragma once

#include <packtrace/image_io.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <filesystem>
#include <string>
#include <variant>

namespace packtrace::cli {

/// A picture in the precision it was rendered in.
using AnyImage = std::variant<Image<float>, Image<double>, Image<long double>>;

/// render() in a precision that is chosen at run time.
[[nodiscard]] AnyImage render_picture(const Scene& scene, Precision precision,
                                      const RenderOptions& options, CutRays* cut = nullptr);

/// write_image() in whatever precision.
void write_picture(const std::filesystem::path& file, const AnyImage& picture,
                   const ImageWriteOptions& options);

/// Says on standard error how many rays `--min-weight` left out of what went to `output`, and how
/// far off that can make a pixel; nothing where all rays are traced.
void print_cut_rays(const std::string& output, const Scene& scene, const RenderOptions& options,
                    const CutRays& cut);

}  // namespace packtrace::cli
