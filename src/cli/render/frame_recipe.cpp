#include "cli/render/frame_recipe.hpp"

#include "core/checksum.hpp"
#include "core/text.hpp"
#include "render/option_words.hpp"
#include "scene/language/numbers.hpp"
#include <packtrace/version.hpp>
#include <packtrace/write_scene.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace packtrace::cli {
namespace {

std::string hash_of(const Scene& scene)
{
    return text_hash_digits(scene_text(scene));
}

/// The options that pixels depend on. They do not depend on width, threads, traversal and
/// --force-general.
std::string text_of(const RenderArguments& arguments, const Scene& scene,
                    const RenderOptions& options)
{
    std::string text = "--size " + std::to_string(scene.width) + "x" + std::to_string(scene.height);
    text += ", --depth " + std::to_string(scene.max_depth);
    text += ", --min-weight " + language::shortest(scene.min_weight);
    text += ", --kernel " + std::string(language::word_of(options.kernel));
    // The only instruction set without fused multiply-add rounds differently from all others.
    if (options.kernel == Kernel::packet)
        text += options.isa == "sse42" ? ", --isa without FMA" : ", --isa with FMA";
    text += ", --precision " + arguments.kernel.precision;
    text += ", --accuracy " + std::string(language::word_of(options.accuracy));
    text += ", --self-hits " + std::string(language::word_of(options.self_hits));
    text += ", --spp " + std::to_string(options.samples);
    if (options.adaptive)
        text += ", --adaptive " + language::shortest(*options.adaptive);
    if (arguments.region)
        text += ", --region " + *arguments.region;
    return text + ", --gamma " + language::shortest(arguments.write.gamma);
}

/// The parts of a recipe, which are separated by commas: the program, the scene, the camera, then
/// the options, and additions of the caller.
std::vector<std::string> parts_of(const std::string& recipe)
{
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin < recipe.size();) {
        const std::size_t end = std::min(recipe.find(", ", begin), recipe.size());
        parts.push_back(recipe.substr(begin, end - begin));
        begin = end + 2;
    }
    return parts;
}

/// "--spp" for "--spp 4"; the whole part if it is not an option.
std::string name_of(const std::string& part)
{
    return part.starts_with("--") ? part.substr(0, part.find(' ')) : part;
}

/// The parts of one recipe that are not in the other, and the options that only the other has.
std::string parts_apart(const std::vector<std::string>& from, const std::vector<std::string>& other)
{
    std::vector<std::string> apart;
    for (const std::string& part : from)
        if (std::find(other.begin(), other.end(), part) == other.end())
            apart.push_back("with " + part);
    for (const std::string& part : other) {
        const auto has_name = [&](const std::string& each) {
            return name_of(each) == name_of(part);
        };
        if (part.starts_with("--") && std::none_of(from.begin(), from.end(), has_name))
            apart.push_back("without " + name_of(part));
    }
    return joined(apart);
}

}  // namespace

void set_usual_picture(Scene& scene)
{
    const Scene usual;
    scene.width = usual.width;
    scene.height = usual.height;
    scene.max_depth = usual.max_depth;
    scene.min_weight = usual.min_weight;
}

FrameRecipe::FrameRecipe(const RenderArguments& arguments, const Scene& scene,
                         const RenderOptions& options)
    : options_(text_of(arguments, scene, options))
{
    // The recipe has the camera of each frame instead of the animation, so that a longer animation
    // keeps its frames. It also has the options instead of the values that they set in the scene.
    Scene still = scene;
    still.animation.reset();
    still.camera = {};
    set_usual_picture(still);
    scene_ = hash_of(still);
}

std::string FrameRecipe::of(const Camera& camera) const
{
    Scene camera_alone{.camera = camera};
    return "packtrace " PACKTRACE_VERSION_STRING ", scene " + scene_ + ", camera " +
           hash_of(camera_alone) + ", " + options_;
}

std::string recipe_difference(const std::string& before, const std::string& now)
{
    const std::vector<std::string> old_parts = parts_of(before);
    const std::vector<std::string> new_parts = parts_of(now);
    static constexpr std::array<const char*, 3> others{"with another version", "with another scene",
                                                       "with another camera"};
    for (std::size_t i = 0; i < others.size(); ++i)
        if (i >= old_parts.size() || i >= new_parts.size() || old_parts[i] != new_parts[i])
            return others[i];
    return parts_apart(old_parts, new_parts) + "; now " + parts_apart(new_parts, old_parts);
}

}  // namespace packtrace::cli
