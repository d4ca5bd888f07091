#pragma once

#include <string>

#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

namespace packtrace::cli {

/// A picture in the precision that `--precision` names, rounded to single.
[[nodiscard]] Image<float> render_picture(const Scene& scene, const std::string& precision,
                                          const RenderOptions& options);

}  // namespace packtrace::cli
