#include "lower/move_objects.hpp"

#include "lower/tree_objects.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <type_traits>
#include <utility>
#include <variant>

namespace packtrace {
namespace {

/// Whether the surface is in the BVH of a scene that is lowered anew.
template <class Kind>
bool stays_in_bvh(const LoweredScene& lowered, const Kind& surface)
{
    if constexpr (std::is_same_v<Kind, LoweredSphere>)
        if (is_anchored(surface))
            return false;
    return is_in_bvh(lowered, surface);
}

/// Moves objects one after another.
class ObjectMover {
public:
    ObjectMover(const abi::SurfaceIndex* index, LoweredScene& lowered)
        : index_(index), lowered_(lowered)
    {
    }

    [[nodiscard]] bool move(const Scene& scene, const MovedShape& shape)
    {
        for_each_list(now_, [](auto& list) { list.clear(); });
        const std::int32_t surface = first_surface(shape.object);
        const int pieces = lower_shape(scene, shape, surface);
        const abi::SurfaceIndex& at = index_[surface];
        bool moved = false;
        for_each_kind([&](auto list) {
            if (!(now_.*list).empty())
                moved = replace((now_.*list).front(), pieces, at, lowered_.*list);
        });
        return moved;
    }

private:
    int lower_shape(const Scene& scene, const MovedShape& shape, std::int32_t surface)
    {
        if (shape.plain) {
            // As in lower_sphere(): -0 becomes 0.
            now_.spheres.push_back({shape.sphere.center + Vec3(0.0), shape.sphere.radius, surface});
            return 1;
        }
        const Object& object = scene.objects[static_cast<std::size_t>(shape.object)];
        return std::visit([&](const auto& kind) { return lower_kind(object, kind, surface, now_); },
                          object.surface);
    }

    template <class Kind>
    bool replace(Kind& now, int pieces, const abi::SurfaceIndex& at, std::vector<Kind>& surfaces)
    {
        if (at.kind != Kind::kind)
            return false;
        Kind& before = surfaces[at.record];
        if (pieces_of(before) != pieces || !stays_in_bvh(lowered_, before) ||
            !stays_in_bvh(lowered_, now))
            return false;
        before = std::move(now);
        return true;
    }

    [[nodiscard]] std::int32_t first_surface(std::int32_t object) const
    {
        const auto& surfaces = lowered_.material_index;
        // Every object has at least one surface: here each has exactly one.
        if (static_cast<std::size_t>(surfaces.back().object) + 1 == surfaces.size())
            return object;
        const auto first = std::lower_bound(
            surfaces.begin(), surfaces.end(), object,
            [](const abi::MaterialIndex& a, std::int32_t number) { return a.object < number; });
        return static_cast<std::int32_t>(first - surfaces.begin());
    }

    const abi::SurfaceIndex* index_;
    LoweredScene& lowered_;
    SurfaceLists now_;  ///< of one object; a member, so that its memory is reused
};

}  // namespace

bool move_objects(const Scene& scene, std::span<const MovedShape> moved,
                  const abi::SurfaceIndex* index, LoweredScene& lowered)
{
    // Enough work for a task to be worth its start.
    constexpr std::size_t task_objects = 1024;
    std::atomic<bool> all = true;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, moved.size(), task_objects),
                      [&](const tbb::blocked_range<std::size_t>& part) {
                          ObjectMover mover(index, lowered);
                          for (std::size_t i = part.begin(); i < part.end() && all; ++i)
                              if (!mover.move(scene, moved[i]))
                                  all = false;
                      });
    return all;
}

}  // namespace packtrace
