#pragma once

#include <packtrace/render.hpp>

namespace packtrace {

/// Most samples a pixel.
inline constexpr int most_samples = 1024;

/// Returns the options. Throws std::invalid_argument with one line when their sampling is
/// impossible.
const RenderOptions& checked_sampling(const RenderOptions& options);

/// What of the scene's picture is rendered. Throws std::invalid_argument for a region that is not
/// within it.
[[nodiscard]] Region checked_region(const RenderOptions& options, const Scene& scene);

}  // namespace packtrace
