#pragma once

#include "kernels/geometry/kinds.hpp"

#include <type_traits>

// The objects that rays are tested against, a list of each kind: all of a scene, or those that a
// cone of rays may meet, with what depends on the rays' origin computed once, by the operations a
// single packet would use, so with the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The objects as rays see them that start from one point.
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

/// The objects with the error bounds of one group of rays: of those from one point, or of those
/// from anywhere in a ball.
template <bool Shared, class List = Kinds>
struct FilteredObjects;
template <bool Shared, class... Kind>
struct FilteredObjects<Shared, KindList<Kind...>> : ListOfKind<Kind, typename Kind::Certain>... {
    static constexpr bool shared = Shared;
    bool certifiable = false;  ///< the scene's sizes and the origins are such that bounds hold
    int count = 0;             ///< in all lists
    Body one = {-1};           ///< of them, where there are any

    bool empty() const
    {
        return count == 0;
    }
};

/// Some objects of a scene, as its lists have them.
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
template <class Kind, bool Shared>
inline const auto& objects_of(const FilteredObjects<Shared>& objects)
{
    return list_of<Kind>(objects);
}

/// Whether any stands in the lists.
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

/// Fills `objects` with what rays of `cone`, all from its base, may meet.
template <abi::Features F, class Real>
inline void find_objects(SharedOriginObjects<Real>& objects, const Cone<Real>& cone,
                         const abi::GeometryView<Real>& scene)
{
    for_each_kind<F>([&](auto kind) {
        find_from_point(list_of<decltype(kind)>(objects), cone, kind.list(scene));
        return true;
    });
}

/// Fills `objects` with what rays of `cone` may meet.
template <abi::Features F, class Real>
inline void find_objects(SelectedObjects<Real>& objects, const Cone<Real>& cone,
                         const abi::GeometryView<Real>& scene)
{
    for_each_kind<F>([&](auto kind) {
        find_met(list_of<decltype(kind)>(objects), cone, kind.list(scene));
        return true;
    });
}

/// Fills `objects` with what rays from `origins` may meet; `cone` bounds them.
template <abi::Features F, bool Shared>
[[gnu::noinline]] void filter_objects(FilteredObjects<Shared>& objects, const Origins& origins,
                                      const Cone<float>& cone, const abi::SceneView<float>& scene)
{
    objects.certifiable = scene.certifiable && certifiable(origins);
    objects.count = 0;
    for_each_kind<F>([&](auto kind) {
        auto& list = list_of<decltype(kind)>(objects);
        find_certain<Shared>(list, origins, cone, kind.list(scene), kind.list(*scene.wide));
        objects.count += list.count;
        if (list.count > 0)
            objects.one = body_of(object_at(list, 0));
        return true;
    });
}

/// What the rays of a cone from one point may meet.
template <abi::Features F>
inline void find_objects(FilteredObjects<true>& objects, const Cone<float>& cone,
                         const abi::SceneView<float>& scene)
{
    filter_objects<F, true>(objects, origins_at(cone.base), cone, scene);
}

/// Puts what rays from a shared origin may meet into the order in which closest hits are found
/// fastest.
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

/// What rays from `origins` may meet, wherever they go.
template <abi::Features F>
inline void find_objects(FilteredObjects<false>& objects, const Origins& origins,
                         const abi::SceneView<float>& scene)
{
    filter_objects<F, false>(objects, origins, Cone<float>{}, scene);
}

/// So many spheres of a hierarchy are picked for lists, at most.
inline constexpr int most_picked_spheres = 20;

/// Gives `objects`, which need not be initialised, room for those of a scene with features `F`, and
/// for spheres of its hierarchy. In place: a copy of lists costs a tile more than to fill them.
template <abi::Features F, class Objects, class Arena, class Real>
inline void take_objects(Arena& arena, Objects& objects, const abi::GeometryView<Real>& scene)
{
    for_each_kind<abi::Features{.quadrics = true}>([&](auto kind) {
        list_of<decltype(kind)>(objects).count = 0;
        return true;
    });
    for_each_kind<F>([&](auto kind) {
        const bool picks = std::is_same_v<decltype(kind), Sphere> && !scene.tree.empty();
        take_room(arena, list_of<decltype(kind)>(objects),
                  kind.list(scene).count + (picks ? most_picked_spheres : 0));
        return true;
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
