#include "lower/leave_out.hpp"

#include <algorithm>

#include "lower/duplicates.hpp"

namespace packtrace {
namespace {

std::string counted(std::size_t count, const std::string& noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void add(std::vector<LeftOut>& left_out, std::size_t count, const std::string& noun,
         const std::string& why)
{
    if (count > 0)
        left_out.push_back({counted(count, noun), why});
}

/// Where rays see the lights themselves, a dark one hides the background.
std::size_t remove_dark_lights(LoweredScene& lowered)
{
    if (lowered.visible_lights)
        return 0;
    return std::erase_if(lowered.lights,
                         [](const Light& light) { return light.intensity == Rgb(0.0); });
}

/// A mirror or a glass counts only where a ray may go on from it, or where the depth limit itself
/// has a colour.
void narrow_bounces(LoweredScene& lowered)
{
    abi::Features& features = lowered.features;
    if (features.bounces && lowered.max_depth == 0 && lowered.limit_color == Rgb(0.0))
        features.bounces = false;
    if (!features.bounces)
        lowered.max_depth = 0;
    features.glass &= lowered.max_depth > 0 || lowered.transparent_shadows;
    features.colored &= features.bounces;
}

void narrow_shadows(LoweredScene& lowered)
{
    const auto& casts = lowered.casts_shadow;
    const bool nothing_casts =
        !casts.empty() && std::find(casts.begin(), casts.end(), true) == casts.end();
    const bool no_light = std::none_of(lowered.lights.begin(), lowered.lights.end(),
                                       [](const Light& light) { return light.casts_shadow; });
    lowered.shadows &= !nothing_casts && !no_light;
    lowered.transparent_shadows &= lowered.shadows;
    if (!lowered.shadows)
        lowered.casts_shadow.clear();
}

/// Hits of a flat scene show their ambient light.
void narrow_hits(LoweredScene& lowered)
{
    lowered.flat = lowered.lights.empty() && !lowered.features.bounces;
}

}  // namespace

std::vector<LeftOut> leave_out(LoweredScene& lowered)
{
    std::vector<LeftOut> left_out;
    add(left_out, remove_dark_lights(lowered), "light", "of no intensity");
    add(left_out, remove_duplicates(lowered), "surface", "in the very place of an earlier one");
    const abi::Features before = lowered.features;
    lowered.features = features_of(lowered);
    lowered.features.probe = before.probe;
    lowered.features.exact = before.exact;
    lowered.features.highlights &= !lowered.lights.empty();
    narrow_shadows(lowered);
    narrow_bounces(lowered);
    narrow_hits(lowered);
    return left_out;
}

std::vector<LeftOut> unused_features(const LoweredScene& lowered, Traversal traversal)
{
    const abi::Features& uses = lowered.features;
    std::vector<LeftOut> unused;
    const auto unless = [&](bool used, const char* what, const char* why) {
        if (!used)
            unused.push_back({what, why});
    };
    unless(traversal == Traversal::tree, "hierarchy", "lists are quicker for so few");
    unless(uses.quadrics, "quadrics", "no surface is one");
    unless(uses.exact, "certain tests and refinement", "--accuracy fast does without");
    unless(!lowered.checkers.empty(), "checkers", "no plane has one");
    unless(!lowered.lights.empty(), "lights", "none shines from a place or a direction");
    unless(!lowered.flat, "normals", "no light and no mirror asks for them");
    unless(uses.highlights || lowered.lights.empty(), "highlights", "no material has one");
    unless(lowered.shadows || lowered.lights.empty(), "shadow rays",
           "nothing casts a shadow, or no light has any");
    unless(uses.bounces, "mirrored rays", "nothing mirrors, or the depth is 0");
    unless(uses.glass, "refracted rays", "nothing lets light through");
    unless(uses.colored || !uses.bounces, "weights by channel", "mirrors and glass are grey");
    return unused;
}

}  // namespace packtrace
