#include "bounds/bounded_scene.hpp"

#include <variant>

#include "bounds/line_hits.hpp"

namespace packtrace::bounds {

BoundedScene::BoundedScene(const Scene& scene)
{
    index_.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        const Sphere* sphere = std::get_if<Sphere>(&object.surface);
        if (sphere != nullptr && object.transform == Mat4(1.0)) {
            index_.push_back(static_cast<std::int32_t>(spheres_.size()));
            spheres_.push_back(*sphere);
        } else {
            index_.push_back(~static_cast<std::int32_t>(placed_.size()));
            placed_.push_back({object.surface, object.transform});
        }
    }
}

std::vector<HitInterval> BoundedScene::hits_of(std::int32_t object, const Line& line) const
{
    const std::int32_t at = index_[static_cast<std::size_t>(object)];
    if (at >= 0)
        return line_hits(spheres_[static_cast<std::size_t>(at)], Mat4(1.0), line);
    const Placed& placed = placed_[static_cast<std::size_t>(~at)];
    return line_hits(placed.surface, placed.transform, line);
}

HitBounds BoundedScene::first_hit(std::int32_t object, const Line& line, const Range& range) const
{
    return first_of(hits_of(object, line), range);
}

void BoundedScene::all_hits(std::int32_t object, const Line& line, const Range& range,
                            std::span<const double> t, std::span<HitBounds> bounds) const
{
    bounds_of(hits_of(object, line), range, t, bounds);
}

}  // namespace packtrace::bounds
