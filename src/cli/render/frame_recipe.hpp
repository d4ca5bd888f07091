#pragma once

#include "cli/render/render_arguments.hpp"
#include <packtrace/camera.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <string>

namespace packtrace::cli {

/// Gives a scene the size, depth and least weight of any other, which options can change.
void set_usual_picture(Scene& scene);

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

/// In which respect two recipes differ, for messages: "with --spp 4; now with --spp 1".
[[nodiscard]] std::string recipe_difference(const std::string& before, const std::string& now);

}  // namespace packtrace::cli
