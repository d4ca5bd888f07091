#pragma once

#include <packtrace/explain.hpp>

namespace packtrace {

/// The ray tree of a pixel of the picture as the scalar reference traces it, in double.
[[nodiscard]] RayNode explain_reference(const Scene& scene, int x, int y);

}  // namespace packtrace
