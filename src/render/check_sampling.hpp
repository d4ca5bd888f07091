#pragma once

#include <packtrace/render.hpp>

namespace packtrace {

/// Most samples a pixel.
inline constexpr int most_samples = 1024;

/// Returns the options. Throws std::invalid_argument with one line when their sampling is
/// impossible.
const RenderOptions& checked_sampling(const RenderOptions& options);

}  // namespace packtrace
