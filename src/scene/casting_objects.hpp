#pragma once

#include <packtrace/scene.hpp>

#include <algorithm>
#include <vector>

namespace packtrace {

/// Whether each object casts a shadow; empty if all do. A RayScene keeps the flags of the scene it
/// was made of, because its update() reads only the shapes of another scene.
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
