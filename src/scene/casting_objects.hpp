#pragma once

#include <packtrace/scene.hpp>

#include <algorithm>
#include <vector>

namespace packtrace {

/// By object whether it casts a shadow; none where all do. A RayScene keeps that of the scene it
/// was made of: its update() reads nothing of another scene but where objects are.
[[nodiscard]] inline std::vector<bool> casting_objects(const Scene& scene)
{
    std::vector<bool> casts;
    const auto casts_shadow = [](const Object& object) { return object.casts_shadow; };
    if (std::all_of(scene.objects.begin(), scene.objects.end(), casts_shadow))
        return casts;
    for (const Object& object : scene.objects)
        casts.push_back(object.casts_shadow);
    return casts;
}

}  // namespace packtrace
