#pragma once

#include "kernels/geometry/anchored_filter.hpp"
#include "kernels/geometry/plane.hpp"
#include "kernels/geometry/polygon.hpp"
#include "kernels/geometry/quadric_filter.hpp"
#include "kernels/geometry/sphere_order.hpp"

// The kinds of objects: a new one is a file, and its name in Kinds. Its file says, with the names
// that the files of the others have:
// - What lists hold of it: the scene's record, all or some (Selected), its form for rays from one
//   point (share_origin), its form with error bounds (certain_form).
// - What a cone of rays leaves out of a list: out_of_reach, leaves_behind.
// - Its tests: keep_closest, occluding_lanes and visit_crossings, or quadratic_of for all three.
// - Its tests with error bounds: keep_certain, occludes.
// - Of its shape in double, the place of a hit: refine, unit_normal, height_over, and form_of where
//   one step of Newton's betters a rough root, or the root next to what the search found.
// - Where rays that start on it meet it again: hit_again, second_crossing.
// - The struct of its name, with the types and lists that the loops ask for.
// What holds of an object unless its kind says otherwise is in object_list.hpp.
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

/// Calls `visit(kind)` for the kinds that scenes of these features have, until it returns false.
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

/// `visit(shape, piece)` of the surface that `index` names.
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

/// The list of one kind, as a base of what holds a list of each.
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

/// The outward unit normal of one surface at a point, for rays of direction `dir`.
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
