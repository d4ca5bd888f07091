#pragma once

#include <string>

#include <packtrace/camera.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include "cli/render/render_arguments.hpp"

namespace packtrace::cli {

/// Says of a frame all that its pixels depend on: the scene, the camera, the options and the
/// version of this program. Frames of one recipe have the same pixels.
class FrameRecipe {
public:
    FrameRecipe(const RenderArguments& arguments, const Scene& scene, const RenderOptions& options);

    [[nodiscard]] std::string of(const Camera& camera) const;

private:
    std::string scene_;
    std::string options_;
};

/// In which respect two recipes differ, for messages.
[[nodiscard]] std::string recipe_difference(const std::string& before, const std::string& now);

}  // namespace packtrace::cli
