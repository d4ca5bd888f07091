#pragma once

#include "cli/render/render_arguments.hpp"
#include <packtrace/camera.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <string>

namespace packtrace::cli {

/// Sets the size, depth and minimum weight of a scene, which options can change, to their defaults.
void set_usual_picture(Scene& scene);

/// A text with everything that the pixels of a frame depend on: the scene, the camera, the options
/// and the version of this program. Frames with equal recipes have equal pixels.
class FrameRecipe {
public:
    FrameRecipe(const RenderArguments& arguments, const Scene& scene, const RenderOptions& options);

    [[nodiscard]] std::string of(const Camera& camera) const;

private:
    std::string scene_;
    std::string options_;
};

/// The difference of two recipes, for messages: "with --spp 4; now with --spp 1".
[[nodiscard]] std::string recipe_difference(const std::string& before, const std::string& now);

}  // namespace packtrace::cli
