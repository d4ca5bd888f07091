#pragma once

#include "kernels/geometry/anchored_filter.hpp"
#include "kernels/geometry/plane.hpp"
#include "kernels/geometry/polygon.hpp"
#include "kernels/geometry/quadric_filter.hpp"
#include "kernels/geometry/sphere_order.hpp"

// The kinds of objects. A new kind is one file, and its name in Kinds. The file defines, with the
// names that the other kinds use:
// - What lists hold: the scene's records, all or some (Selected), their form for rays from one
//   point (share_origin), and their form with error bounds (certain_form).
// - Which objects of a list a cone of rays can skip: out_of_reach, leaves_behind.
// - Its tests: keep_closest, occluding_lanes and visit_crossings, or quadratic_of for all three.
// - Its tests with error bounds: keep_certain, occludes.
// - For its shape in double, the point of a hit: refine, unit_normal, height_over. Also form_of, if
//   one Newton step improves a rough root, or improves the root next to what the search found.
// - Where rays that start on it hit it again: hit_again, second_crossing.
// - The struct with the kind's name, which has the types and lists that the loops use.
// object_list.hpp has defaults, for kinds that do not define a function.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Object, class Real>
concept HasQuadratic = requires(const Object& object, const RayPacket<Real>& rays)
{
    quadratic_of(object, rays);
};

template <class Object, class Real, class Own>
requires HasQuadratic<Object, Real>
inline void keep_closest(HitPacket<Real>& hit, const Object& object, const RayPacket<Real>& rays,
                         const Own& own)
{
    keep_quadratic(hit, quadratic_of(object, rays), rays, body_of(object).first, own);
}

template <class Object, class Real>
requires HasQuadratic<Object, Real>
inline std::uint32_t occluding_lanes(const RayEnd<Real>& end, const Object& object,
                                     const RayPacket<Real>& rays)
{
    return bits(end.blocked_by(quadratic_of(object, rays), rays));
}

template <class Object, class Real, class Visit>
requires HasQuadratic<Object, Real>
inline void visit_crossings(const Object& object, const RayPacket<Real>& rays, const Visit& visit)
{
    visit_roots(quadratic_of(object, rays),
                [&](vmask<Real> valid, const vreal<Real>& t) { visit(valid, t, 0); });
}

template <class... Kind>
struct KindList {
};
using Kinds = KindList<Sphere, AnchoredSphere, Plane, Quadric, Polygon>;

/// Calls `visit(kind)` for the kinds that are compiled with these features, until it returns false.
template <abi::Features F, class Visit, class... Kind>
inline bool for_each_kind(const Visit& visit, KindList<Kind...>)
{
    const auto visit_one = [&](auto kind) {
        if constexpr (kind.in(F))
            return visit(kind);
        else
            return true;
    };
    return (visit_one(Kind{}) && ...);
}
template <abi::Features F, class Visit>
inline bool for_each_kind(const Visit& visit)
{
    return for_each_kind<F>(visit, Kinds{});
}

/// Returns `visit(shape, piece)` for the surface that `index` names.
template <class Visit, class First, class... Rest>
inline auto with_shape(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                       const Visit& visit, KindList<First, Rest...>)
{
    const unsigned piece =
        static_cast<unsigned>(index.kind) - static_cast<unsigned>(First::first_surface);
    if constexpr (sizeof...(Rest) == 0) {
        return visit(First::shapes(shapes)[index.record], piece);
    } else {
        if (piece < First::surfaces)
            return visit(First::shapes(shapes)[index.record], piece);
        return with_shape(shapes, index, visit, KindList<Rest...>{});
    }
}
template <class Visit>
inline auto with_shape(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                       const Visit& visit)
{
    return with_shape(shapes, index, visit, Kinds{});
}

/// The list of one kind: a base class of structs that hold a list of each kind.
template <class Kind, class List>
struct ListOfKind {
    List list;
};
template <class Kind, class List>
inline List& list_of(ListOfKind<Kind, List>& lists)
{
    return lists.list;
}
template <class Kind, class List>
inline const List& list_of(const ListOfKind<Kind, List>& lists)
{
    return lists.list;
}

/// The outward unit normal of a surface at a point, for rays with direction `dir`.
template <class Real>
inline Vec3v<Real> surface_normal(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                  const Vec3v<Real>& point, const Vec3v<Real>& dir)
{
    if (index.kind == abi::SurfaceKind::none)
        return unit_or_against<Real>(dir, dir);
    return with_shape(shapes, index, [&](const auto& shape, unsigned piece) {
        return unit_normal<Real>(shape, piece, point, dir);
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
