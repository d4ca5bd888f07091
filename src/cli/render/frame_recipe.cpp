#include "cli/render/frame_recipe.hpp"

#include <packtrace/version.hpp>
#include <packtrace/write_scene.hpp>

#include "core/checksum.hpp"
#include "scene/language/numbers.hpp"

namespace packtrace::cli {
namespace {

std::string hash_of(const Scene& scene)
{
    return text_hash_digits(scene_text(scene));
}

/// Width, threads, traversal and --force-general are not among them: no pixel depends on those.
std::string text_of(const RenderArguments& arguments, const RenderOptions& options)
{
    const bool packets = options.kernel == Kernel::packet;
    // The one instruction set without fused multiply-add rounds otherwise than all others.
    std::string text = !packets                 ? "scalar"
                       : options.isa == "sse42" ? "packet without FMA"
                                                : "packet";
    text += ", " + arguments.kernel.precision;
    text += ", accuracy " + std::to_string(static_cast<int>(options.accuracy));
    text += ", self hits " + std::to_string(static_cast<int>(options.self_hits));
    text += ", samples " + std::to_string(options.samples);
    if (options.adaptive)
        text += ", adaptive " + language::shortest(*options.adaptive);
    if (arguments.region)
        text += ", region " + *arguments.region;
    return text + ", gamma " + language::shortest(arguments.write.gamma);
}

/// The parts of a recipe that commas end: the program, the scene, the camera; then all else.
std::string part_of(const std::string& recipe, int number)
{
    std::size_t begin = 0;
    for (int i = 0; i < number; ++i)
        if (begin = recipe.find(", ", begin); begin != std::string::npos)
            begin += 2;
        else
            return {};
    return recipe.substr(begin, number == 3 ? std::string::npos : recipe.find(", ", begin) - begin);
}

}  // namespace

FrameRecipe::FrameRecipe(const RenderArguments& arguments, const Scene& scene,
                         const RenderOptions& options)
    : options_(text_of(arguments, options))
{
    // The camera of each frame is named by itself, so that a longer animation keeps its frames.
    Scene still = scene;
    still.animation.reset();
    still.camera = {};
    scene_ = hash_of(still);
}

std::string FrameRecipe::of(const Camera& camera) const
{
    Scene camera_alone;
    camera_alone.camera = camera;
    return "packtrace " PACKTRACE_VERSION_STRING ", scene " + scene_ + ", camera " +
           hash_of(camera_alone) + ", " + options_;
}

std::string recipe_difference(const std::string& before, const std::string& now)
{
    if (part_of(before, 0) != part_of(now, 0))
        return "another version";
    if (part_of(before, 1) != part_of(now, 1))
        return "another scene, or options that change the scene";
    return part_of(before, 2) != part_of(now, 2) ? "another camera" : "other options";
}

}  // namespace packtrace::cli
