#pragma once

#include "kernels/geometry/kinds.hpp"

#include <type_traits>

// The objects that rays are tested against, one list per kind: all objects of a scene, or those
// that a cone of rays may hit. Values that depend only on the rays' origin are computed once, by
// the operations that a single packet would use, so with the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The objects for rays that start from one point.
template <class Real, class List = Kinds>
struct SharedOriginObjects;
template <class Real, class... Kind>
struct SharedOriginObjects<Real, KindList<Kind...>>
    : ListOfKind<Kind, typename Kind::template FromPoint<Real>>... {
    bool empty() const
    {
        return (list_of<Kind>(*this).count + ...) == 0;
    }
};

/// The objects with error bounds for a set of rays: from one point, or from anywhere in a ball.
template <Origin O, class List = Kinds>
struct FilteredObjects;
template <Origin O, class... Kind>
struct FilteredObjects<O, KindList<Kind...>> : ListOfKind<Kind, typename Kind::Certain>... {
    static constexpr Origin origin = O;
    bool certifiable = false;  ///< the bounds hold for the scene's sizes and for the origins
    int count = 0;             ///< in all lists
    Body one = {-1};           ///< any of the objects, if there are any

    bool empty() const
    {
        return count == 0;
    }
};

/// Some objects of a scene, as its lists store them.
template <class Real, class List = Kinds>
struct SelectedObjects;
template <class Real, class... Kind>
struct SelectedObjects<Real, KindList<Kind...>>
    : ListOfKind<Kind, typename Kind::template Selected<Real>>... {
    bool empty() const
    {
        return (list_of<Kind>(*this).count + ...) == 0;
    }
};

template <class Kind, class Real>
inline const auto& objects_of(const abi::GeometryView<Real>& scene)
{
    return Kind::list(scene);
}
template <class Kind, class Real>
inline const auto& objects_of(const SelectedObjects<Real>& objects)
{
    return list_of<Kind>(objects);
}
template <class Kind, class Real>
inline const auto& objects_of(const SharedOriginObjects<Real>& objects)
{
    return list_of<Kind>(objects);
}
template <class Kind, Origin O>
inline const auto& objects_of(const FilteredObjects<O>& objects)
{
    return list_of<Kind>(objects);
}

/// Whether the lists contain any object.
template <abi::Features F, class Objects>
inline bool has_objects(const Objects& objects)
{
    bool any = false;
    for_each_kind<F>([&](auto kind) {
        any = objects_of<decltype(kind)>(objects).count > 0;
        return !any;
    });
    return any;
}

/// Fills `objects` with those that rays of `cone` may hit; all rays start at its base.
template <abi::Features F, class Real>
inline void find_objects(SharedOriginObjects<Real>& objects, const Cone<Real>& cone,
                         const abi::GeometryView<Real>& scene)
{
    for_each_kind<F>([&](auto kind) {
        find_from_point(list_of<decltype(kind)>(objects), cone, kind.list(scene));
        return true;
    });
}

/// Fills `objects` with those that rays of `cone` may hit.
template <abi::Features F, class Real>
inline void find_objects(SelectedObjects<Real>& objects, const Cone<Real>& cone,
                         const abi::GeometryView<Real>& scene)
{
    for_each_kind<F>([&](auto kind) {
        find_met(list_of<decltype(kind)>(objects), cone, kind.list(scene));
        return true;
    });
}

/// Fills `objects` with those that rays from `origins` may hit; `cone` bounds the rays.
template <abi::Features F, Origin O>
[[gnu::noinline]] void filter_objects(FilteredObjects<O>& objects, const Origins& origins,
                                      const Cone<float>& cone, const abi::SceneView<float>& scene)
{
    objects.certifiable = scene.certifiable && certifiable(origins);
    objects.count = 0;
    for_each_kind<F>([&](auto kind) {
        auto& list = list_of<decltype(kind)>(objects);
        find_certain<O>(list, origins, cone, kind.list(scene), kind.list(*scene.wide));
        objects.count += list.count;
        if (list.count > 0)
            objects.one = body_of(object_at(list, 0));
        return true;
    });
}

/// Fills `objects` with those that rays of `cone` may hit; all rays start at its base.
template <abi::Features F>
inline void find_objects(FilteredObjects<Origin::shared>& objects, const Cone<float>& cone,
                         const abi::SceneView<float>& scene)
{
    filter_objects<F, Origin::shared>(objects, origins_at(cone.base), cone, scene);
}

/// Sorts the objects that rays from a shared origin may hit into the order in which closest hits
/// are found fastest.
template <abi::Features F, class Objects>
inline void sort_by_distance(Objects& objects)
{
    for_each_kind<F>([&](auto kind) {
        auto& list = list_of<decltype(kind)>(objects);
        if constexpr (requires { sort_by_distance(list); })
            sort_by_distance(list);
        return true;
    });
}

/// Fills `objects` with those that rays from `origins` may hit in any direction.
template <abi::Features F>
inline void find_objects(FilteredObjects<Origin::any>& objects, const Origins& origins,
                         const abi::SceneView<float>& scene)
{
    filter_objects<F, Origin::any>(objects, origins, Cone<float>{}, scene);
}

/// The largest number of spheres of a BVH that are picked into lists.
inline constexpr int most_picked_spheres = 20;

/// Takes memory in `objects`, which need not be initialised, for the objects of a scene with
/// features `F` and for spheres picked from its BVH. It works in place: copying the lists would
/// cost a tile more than filling them.
template <abi::Features F, class Objects, class Arena, class Real>
inline void take_objects(Arena& arena, Objects& objects, const abi::GeometryView<Real>& scene)
{
    for_each_kind<abi::Features{.quadrics = true}>([&](auto kind) {
        list_of<decltype(kind)>(objects).count = 0;
        return true;
    });
    for_each_kind<F>([&](auto kind) {
        const bool picks = std::is_same_v<decltype(kind), Sphere> && !scene.tree.empty();
        take_memory(arena, list_of<decltype(kind)>(objects),
                    kind.list(scene).count + (picks ? most_picked_spheres : 0));
        return true;
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
