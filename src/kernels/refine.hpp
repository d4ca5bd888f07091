#pragma once

#include "kernels/leave_surface.hpp"
#include "kernels/quadric_filter.hpp"

// Hits as shading and callers want them. The search says which surface a ray meets first; where
// exactly is found once a ray, in double: the first root beyond t_min of that one surface, so that
// the result hangs on the ray and the surface alone, whatever decided between surfaces.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A packet of hits with all that shading needs of the place.
template <class Real>
struct RefinedHits {
    vreal<Real> t;
    Vec3v<Real> point;
    Vec3v<Real> normal;  ///< outwards and unit
};

/// Half a packet of them.
struct RefinedHalf {
    vreal<double> t;
    Vec3v<double> point;
    Vec3v<double> normal;
};

inline Vec3v<double> point_at(const RayPacket<double>& rays, const vreal<double>& t)
{
    return madd<double>(t, rays.dir, rays.org);
}

/// The first root beyond t_min. A ray that only grazes the surface in double touches it.
inline vreal<double> first_root(const Quadratic<double>& quadratic, const vreal<double>& t_min)
{
    const vreal<double> root = sqrt(max(quadratic.discriminant, vreal<double>(0.0)));
    const vreal<double> minus_q = quadratic.b + with_sign_of(root, quadratic.b);
    const vreal<double> first = negated(quadratic.c) / minus_q;
    // For t_min >= 0 this is the first root that can count.
    const auto counts = first > t_min;
    if (all(counts))
        return first;
    return select(counts, first, negated(minus_q) / quadratic.a);
}

inline RefinedHalf refine(const abi::SphereShape& sphere, const RayPacket<double>& rays)
{
    const vreal<double> radius2(sphere.radius * sphere.radius);
    const Vec3v<double> o = rays.org - broadcast(sphere.center);
    RefinedHalf hit;
    hit.t =
        first_root(sphere_quadratic<double>(rays, o, radius2, sphere_constant<double>(o, radius2)),
                   rays.t_min);
    hit.point = point_at(rays, hit.t);
    hit.normal = normal_at<double>(sphere, hit.point);
    return hit;
}

inline RefinedHalf refine(const abi::AnchoredSphere<double>& sphere, const RayPacket<double>& rays)
{
    RefinedHalf hit;
    hit.t = first_root(quadratic_of(sphere, rays), rays.t_min);
    hit.point = point_at(rays, hit.t);
    hit.normal = normal_at<double>(sphere, hit.point);
    return hit;
}

inline RefinedHalf refine(const abi::PlaneRecord<double>& plane, const RayPacket<double>& rays)
{
    const vreal<double> t = plane_t(plane, rays);
    return {t, point_at(rays, t), broadcast(plane.normal)};
}

/// The first of the crossings of one piece.
[[gnu::noinline]] inline RefinedHalf refine_piece(const abi::QuadricRecord<double>& quadric,
                                                  int wanted, const RayPacket<double>& rays)
{
    vreal<double> first(__builtin_inf());
    const QuadricOrigin<double> origin = quadric_origin<double>(quadric, rays.org);
    visit_crossings(quadric, origin, rays,
                    [&](vmask<double> valid, const vreal<double>& t, int piece) {
                        if (piece == wanted)
                            first = select(valid & (t > rays.t_min) & (t < first), t, first);
                    });
    RefinedHalf hit;
    hit.t = first;
    hit.point = point_at(rays, first);
    const Vec3v<double> v = apply_inverse(quadric, rays.dir);
    const Vec3v<double> gradient =
        wanted == 0 ? side_gradient<double>(quadric, madd<double>(first, v, origin.p))
                    : cap_gradient<double>(quadric, wanted == 2);
    hit.normal = unit_or_against<double>(gradient, rays.dir);
    return hit;
}

inline RefinedHalf refine(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                          const RayPacket<double>& rays)
{
    switch (index.kind) {
        case abi::SurfaceKind::sphere:
            return refine(shapes.spheres[index.record], rays);
        case abi::SurfaceKind::anchored_sphere:
            return refine(shapes.anchored_spheres[index.record], rays);
        case abi::SurfaceKind::plane:
            return refine(shapes.planes[index.record], rays);
        default:
            return refine_piece(
                shapes.quadrics[index.record],
                static_cast<int>(index.kind) - static_cast<int>(abi::SurfaceKind::quadric_side),
                rays);
    }
}

/// Refines the hits of the lanes of `same`, all on one surface.
inline void refine_surface(RefinedHits<float>& hits, const abi::ShapesView& shapes,
                           const abi::SurfaceIndex& index, const RayPacket<double>& low,
                           const RayPacket<double>& high, const vmask<float>& same)
{
    const RefinedHalf a = refine(shapes, index, low);
    const RefinedHalf b = refine(shapes, index, high);
    hits.t = select(same, narrow(a.t, b.t), hits.t);
    hits.point = select(same, narrow(a.point, b.point), hits.point);
    hits.normal = select(same, narrow(a.normal, b.normal), hits.normal);
}

/// Hits on the surfaces that rays start on, whose t is known.
[[gnu::noinline]] inline void refine_second(RefinedHits<float>& hits, const abi::ShapesView& shapes,
                                            const StartPacket<float>& start,
                                            const RayPacket<float>& rays, std::uint32_t again)
{
    const auto half = [&](const Vec3v<double>& from, const Vec3v<double>& dir,
                          const vreal<double>& t) { return madd<double>(t, dir, from); };
    const Vec3v<double> low_dir = widen_low(rays.dir);
    const Vec3v<double> high_dir = widen_high(rays.dir);
    const Vec3v<double> low = half(widen_low(start.point), low_dir, widen_low(start.second));
    const Vec3v<double> high = half(widen_high(start.point), high_dir, widen_high(start.second));
    const vmask<float> lanes_again = from_bits<float>(again);
    hits.t = select(lanes_again, start.second, hits.t);
    hits.point = select(lanes_again, narrow(low, high), hits.point);
    for_each_distinct<float>(start.surface, again, [&](std::int32_t number, vmask<float> same) {
        const abi::SurfaceIndex& index = shapes.index[number];
        const Vec3v<float> normal = narrow(surface_normal<double>(shapes, index, low, low_dir),
                                           surface_normal<double>(shapes, index, high, high_dir));
        hits.normal = select(from_bits<float>(bits(same) & again), normal, hits.normal);
    });
}

/// The places of the hits of `active`, in double for rays that the search was certain of.
[[gnu::noinline]] inline void refine_packet(RefinedHits<float>& hits, const abi::ShapesView& shapes,
                                            const RayPacket<float>& rays,
                                            const vint<float>& surface,
                                            const StartPacket<float>& start, std::uint32_t active)
{
    const std::uint32_t again = bits(int_equal(surface, start.surface)) & active;
    const std::uint32_t others = active & ~again;
    if (others != 0) {
        const RayPacket<double> low = widen_low(rays);
        const RayPacket<double> high = widen_high(rays);
        for_each_distinct<float>(
            surface, others, [&](std::int32_t number, const vmask<float>& same) {
                refine_surface(hits, shapes, shapes.index[number], low, high, same);
            });
    }
    if (again != 0)
        refine_second(hits, shapes, start, rays, again);
}

/// The places of the hits of `active`. Those on a ray's own surface are where it starts and second
/// root say.
template <abi::Features F, class Real>
inline RefinedHits<Real> refined(const abi::ShapesView& shapes, const RayPacket<Real>& rays,
                                 const HitPacket<Real>& hit, const StartPacket<Real>& start,
                                 std::uint32_t active)
{
    RefinedHits<Real> hits;
    hits.t = hit.t;
    if constexpr (F.exact) {
        hits.point = hits.normal = rays.dir;
        refine_packet(hits, shapes, rays, hit.surface, start, active);
    } else {
        const auto again = int_equal(hit.surface, start.surface);
        hits.t = select(again, start.second, hit.t);
        hits.point = madd<Real>(hits.t, rays.dir, select(again, start.point, rays.org));
        hits.normal = rays.dir;
        for_each_distinct<Real>(hit.surface, active, [&](lane_int<Real> number, vmask<Real> same) {
            hits.normal = select(
                same, surface_normal<Real>(shapes, shapes.index[number], hits.point, rays.dir),
                hits.normal);
        });
    }
    return hits;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
