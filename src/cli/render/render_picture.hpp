#pragma once

#include <packtrace/image_io.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <filesystem>
#include <string>
#include <variant>

namespace packtrace::cli {

/// A picture in the precision of its rendering.
using AnyImage = std::variant<Image<float>, Image<double>, Image<long double>>;

/// "12.3 GB"
[[nodiscard]] std::string gigabytes(double bytes);

/// render() with a precision that is chosen at run time. If memory runs out, it throws
/// std::runtime_error with the size of a large picture, and std::bad_alloc for a small picture.
[[nodiscard]] AnyImage render_picture(const Scene& scene, Precision precision,
                                      const RenderOptions& options, CutRays* cut = nullptr);

/// write_image() for any precision.
void write_picture(const std::filesystem::path& file, const AnyImage& picture,
                   const ImageWriteOptions& options);

/// Prints on standard error how many rays of `output` were cut because of `--min-weight`, and the
/// bound of the resulting error of a pixel. Prints nothing if all rays are traced.
void print_cut_rays(const std::string& output, const Scene& scene, const RenderOptions& options,
                    const CutRays& cut);

}  // namespace packtrace::cli
