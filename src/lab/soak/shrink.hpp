#pragma once

#include "lab/soak/soak_finding.hpp"

namespace packtrace::lab {

/// A scene as its file says it: what is found in it, the file shows. Throws SceneError and
/// std::invalid_argument for what the language can't say.
[[nodiscard]] Scene as_read(const Scene& scene);

/// A scene in which the finding still shows and of which nothing more can be left out: objects,
/// lights, transforms, contours, materials, depth, pixels. `finding.what` becomes what shows in it.
[[nodiscard]] Scene shrink(SoakFinding& finding, Scene scene);

}  // namespace packtrace::lab
