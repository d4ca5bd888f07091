#pragma once

#include "kernels/geometry/plane.hpp"
#include "kernels/geometry/quadric_filter.hpp"
#include "kernels/precision/leave_surface.hpp"

// Hits as shading and callers want them. The search says which surface a ray meets first; where
// exactly is found once a ray: the first root beyond t_min of that one surface, so that the result
// hangs on the ray and the surface alone, whatever decided between surfaces. A root of single
// precision is bettered by one step of Newton's, whose residual is of doubles; where that is not
// enough, the equation is solved in double.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A packet of hits with all that shading needs of the place.
template <class Real>
struct RefinedHits {
    vreal<Real> t;
    Vec3v<Real> point;
    Vec3v<Real> normal;  ///< outwards and unit
};

/// What is asked for of a hit.
enum class Refine { t, place };

/// Half a packet of them.
struct RefinedHalf {
    vreal<double> t;
    Vec3v<double> point;
    Vec3v<double> normal;
};

/// A value for each half of a packet of floats.
template <class Value>
struct BothHalves {
    Value low, high;
};

inline BothHalves<Vec3v<double>> widen(const Vec3v<float>& v)
{
    return {widen_low(v), widen_high(v)};
}

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

/// Spheres, one a lane or one for all: |w|² = radius² for w from the centre.
struct SphereForm {
    BothHalves<Vec3v<double>> base;
    BothHalves<vreal<double>> radius2;
    Vec3v<float> rough_base;
    vreal<float> rough_radius;
};

/// Anchored spheres and, with no curvature, planes: (g + n)·w + offset = 0 for g = n + curvature w.
struct AnchoredForm {
    BothHalves<Vec3v<double>> base;
    Vec3v<double> normal;
    vreal<double> curvature;
    vreal<double> offset;
    Vec3v<float> rough_base;
    Vec3v<float> rough_normal;
    vreal<float> rough_curvature;
    vreal<float> rough_offset;
};

inline vreal<float> rough(double x)
{
    return vreal<float>(static_cast<float>(x));
}
inline Vec3v<float> rough(const double (&v)[3])
{
    return {rough(v[0]), rough(v[1]), rough(v[2])};
}

inline SphereForm form_of(const abi::SphereShape& sphere)
{
    const Vec3v<double> center = broadcast(sphere.center);
    const vreal<double> radius2(sphere.radius * sphere.radius);
    return {{center, center}, {radius2, radius2}, rough(sphere.center), rough(sphere.radius)};
}
inline AnchoredForm anchored_form(const double (&base)[3], const double (&normal)[3],
                                  double curvature, double offset)
{
    return {{broadcast(base), broadcast(base)},
            broadcast(normal),
            vreal<double>(curvature),
            vreal<double>(offset),
            rough(base),
            rough(normal),
            rough(curvature),
            rough(offset)};
}
inline AnchoredForm form_of(const abi::AnchoredSphere<double>& sphere)
{
    return anchored_form(sphere.anchor, sphere.normal, sphere.curvature, sphere.offset);
}
inline AnchoredForm form_of(const abi::PlaneRecord<double>& plane)
{
    return anchored_form(plane.point, plane.normal, 0.0, 0.0);
}

/// A root in single precision: the first beyond t_min, as far as that can tell.
struct RoughRoot {
    vreal<float> t;
    vreal<float> bend;  ///< half the second derivative along the ray
};

inline RoughRoot rough_root(const SphereForm& form, const RayPacket<float>& rays)
{
    const Vec3v<float> w = rays.org - form.rough_base;
    const Vec3v<float> moment = cross(w, rays.dir);
    const vreal<float> across = rays.dir2 * (form.rough_radius * form.rough_radius);
    const vreal<float> root = sqrt(max(across - dot(moment, moment), vreal<float>(0.0f)));
    const vreal<float> b = dot(w, rays.dir);
    const vreal<float> inverse = vreal<float>(1.0f) / rays.dir2;
    const vreal<float> near = negated(b + root) * inverse;
    const auto counts = near > rays.t_min;
    // Gradients of smaller spheres lose digits to underflow: nothing is enough for a NaN.
    const auto small = form.rough_radius < vreal<float>(1e-30f);
    const vreal<float> t = select(counts, near, (root - b) * inverse);
    return {select(small, vreal<float>(__builtin_nanf("")), t), rays.dir2};
}

inline RoughRoot rough_root(const AnchoredForm& form, const RayPacket<float>& rays)
{
    const Vec3v<float> w = rays.org - form.rough_base;
    const Vec3v<float> g = madd<float>(form.rough_curvature, w, form.rough_normal);
    const vreal<float> value = dot(g + form.rough_normal, w) + form.rough_offset;
    const vreal<float> bend = form.rough_curvature * rays.dir2;
    const vreal<float> b = dot(g, rays.dir);
    vreal<float> discriminant = msub(b, b, bend * value);
    const auto far = dot(g, g) > vreal<float>(4.0f);
    if (any(far)) {
        const Vec3v<float> moment = cross(g, rays.dir);
        discriminant = select(far, rays.dir2 - dot(moment, moment), discriminant);
    }
    const vreal<float> root = sqrt(max(discriminant, vreal<float>(0.0f)));
    const vreal<float> minus_q = b + with_sign_of(root, b);
    const vreal<float> first = negated(value) / minus_q;
    const auto counts = first > rays.t_min;
    if (all(counts))
        return {first, bend};
    return {select(counts, first, negated(minus_q) / bend), bend};
}

/// The residual of a packet at t, half its derivative along the ray, and half its gradient.
struct Residual {
    vreal<float> value;
    vreal<float> slope;
    Vec3v<float> gradient;
};

inline Vec3v<double> from_base(const Vec3v<double>& org, const Vec3v<double>& dir,
                               const vreal<double>& t, const Vec3v<double>& base)
{
    return madd<double>(t, dir, org - base);
}

/// The rays of a packet in double.
struct WideRays {
    BothHalves<Vec3v<double>> org;
    BothHalves<Vec3v<double>> dir;

    explicit WideRays(const RayPacket<float>& rays) : org(widen(rays.org)), dir(widen(rays.dir))
    {
    }
};

inline Residual residual(const SphereForm& form, const WideRays& rays, const vreal<float>& t)
{
    const Vec3v<double> low = from_base(rays.org.low, rays.dir.low, widen_low(t), form.base.low);
    const Vec3v<double> high =
        from_base(rays.org.high, rays.dir.high, widen_high(t), form.base.high);
    return {narrow(dot(low, low) - form.radius2.low, dot(high, high) - form.radius2.high),
            narrow(dot(low, rays.dir.low), dot(high, rays.dir.high)), narrow(low, high)};
}

inline Residual residual(const AnchoredForm& form, const WideRays& rays, const vreal<float>& t)
{
    const Vec3v<double> low = from_base(rays.org.low, rays.dir.low, widen_low(t), form.base.low);
    const Vec3v<double> high =
        from_base(rays.org.high, rays.dir.high, widen_high(t), form.base.high);
    const Vec3v<double> g_low = madd<double>(form.curvature, low, form.normal);
    const Vec3v<double> g_high = madd<double>(form.curvature, high, form.normal);
    return {narrow(dot(g_low + form.normal, low) + form.offset,
                   dot(g_high + form.normal, high) + form.offset),
            narrow(dot(g_low, rays.dir.low), dot(g_high, rays.dir.high)), narrow(g_low, g_high)};
}

/// The unit normal a `step` from where the gradient was taken.
inline Vec3v<float> normal_of(const SphereForm& form, const Vec3v<float>& gradient,
                              const Vec3v<float>& step)
{
    return scale<float>(vreal<float>(1.0f) / form.rough_radius, gradient + step);
}
inline Vec3v<float> normal_of(const AnchoredForm& form, const Vec3v<float>& gradient,
                              const Vec3v<float>& step)
{
    return madd<float>(form.rough_curvature, step, gradient);
}

/// The lanes in which t + dt is within 2^-30 of the first root beyond t_min. Newton's step leaves
/// bend dt² / slope / 2 of the error dt it began with.
inline std::uint32_t is_enough(const RoughRoot& root, const vreal<float>& slope,
                               const vreal<float>& dt, const vreal<float>& t_min)
{
    const vreal<float> size = abs(dt);
    const vreal<float> steep = abs(slope);
    const vreal<float> bent = root.bend * size;
    const std::uint32_t close = bits(bent <= vreal<float>(0x1p-11f) * steep) &
                                bits(bent * size <= vreal<float>(0x1p-30f) * (steep * root.t)) &
                                bits(size <= vreal<float>(0x1p-9f) * root.t) &
                                bits(root.t + dt > t_min);
    // Leaving, the ray must have entered before t_min: the roots' middle is slope / bend before t,
    // so the other root dt + 2 slope / bend before.
    const vreal<float> since =
        madd(root.bend, (root.t - dt) - t_min, vreal<float>(0x1p-22f) * (root.bend * root.t));
    const std::uint32_t first =
        bits(slope < vreal<float>(0.0f)) | bits(vreal<float>(2.0f - 0x1p-18f) * slope > since);
    return close & first;
}

/// Refines the lanes of `same`, whose surfaces are `form`; returns those for which it was enough.
template <Refine R, class Form>
inline std::uint32_t refine_by_newton(RefinedHits<float>& hits, const Form& form,
                                      const RayPacket<float>& rays, const WideRays& wide,
                                      std::uint32_t same)
{
    const RoughRoot root = rough_root(form, rays);
    const Residual at = residual(form, wide, root.t);
    const vreal<float> dt = vreal<float>(-0.5f) * at.value / at.slope;
    const std::uint32_t done = same & is_enough(root, at.slope, dt, rays.t_min);
    const vmask<float> active = from_bits<float>(done);
    hits.t = select(active, root.t + dt, hits.t);
    if constexpr (R == Refine::place) {
        const vreal<double> t_low = widen_low(root.t) + widen_low(dt);
        const vreal<double> t_high = widen_high(root.t) + widen_high(dt);
        hits.point = select(active,
                            narrow(madd<double>(t_low, wide.dir.low, wide.org.low),
                                   madd<double>(t_high, wide.dir.high, wide.org.high)),
                            hits.point);
        hits.normal =
            select(active, normal_of(form, at.gradient, scale<float>(dt, rays.dir)), hits.normal);
    }
    return done;
}

/// The same of surfaces of whatever kind, all lanes of `same` on one.
template <Refine R>
inline std::uint32_t refine_by_newton(RefinedHits<float>& hits, const abi::ShapesView& shapes,
                                      const abi::SurfaceIndex& index, const RayPacket<float>& rays,
                                      const WideRays& wide, std::uint32_t same)
{
    const auto with = [&](const auto& form) {
        return refine_by_newton<R>(hits, form, rays, wide, same);
    };
    switch (index.kind) {
        case abi::SurfaceKind::sphere:
            return with(form_of(shapes.spheres[index.record]));
        case abi::SurfaceKind::anchored_sphere:
            return with(form_of(shapes.anchored_spheres[index.record]));
        case abi::SurfaceKind::plane:
            return with(form_of(shapes.planes[index.record]));
        default:
            return 0;
    }
}

/// `form` with another sphere in the lanes of `same`.
inline SphereForm blended(const SphereForm& form, const abi::SphereShape& sphere,
                          std::uint32_t same)
{
    const SphereForm other = form_of(sphere);
    const vmask<float> lanes_of = from_bits<float>(same);
    const vmask<double> low = from_bits<double>(same & all_lanes<double>);
    const vmask<double> high = from_bits<double>(same >> lanes<double>);
    return {
        {select(low, other.base.low, form.base.low), select(high, other.base.high, form.base.high)},
        {select(low, other.radius2.low, form.radius2.low),
         select(high, other.radius2.high, form.radius2.high)},
        select(lanes_of, other.rough_base, form.rough_base),
        select(lanes_of, other.rough_radius, form.rough_radius)};
}

/// The hits of the lanes of `same`, all on one surface, by solving its equation in double.
[[gnu::noinline]] inline void solve_in_double(RefinedHits<float>& hits,
                                              const abi::ShapesView& shapes,
                                              const abi::SurfaceIndex& index,
                                              const RayPacket<float>& rays, std::uint32_t lanes_of)
{
    const vmask<float> same = from_bits<float>(lanes_of);
    const RefinedHalf a = refine(shapes, index, widen_low(rays));
    const RefinedHalf b = refine(shapes, index, widen_high(rays));
    hits.t = select(same, narrow(a.t, b.t), hits.t);
    hits.point = select(same, narrow(a.point, b.point), hits.point);
    hits.normal = select(same, narrow(a.normal, b.normal), hits.normal);
}

/// Hits on the bodies that rays start on, whose t is known.
[[gnu::noinline]] inline void refine_second(RefinedHits<float>& hits, const abi::ShapesView& shapes,
                                            const StartPacket<float>& start,
                                            const RayPacket<float>& rays, std::uint32_t again)
{
    const auto half = [&](const Vec3v<double>& from, const Vec3v<double>& dir,
                          const vreal<double>& t) { return madd<double>(t, dir, from); };
    const Vec3v<double> low_dir = widen_low(rays.dir);
    const Vec3v<double> high_dir = widen_high(rays.dir);
    const Vec3v<double> low = half(widen_low(start.point), low_dir, widen_low(start.second.t));
    const Vec3v<double> high = half(widen_high(start.point), high_dir, widen_high(start.second.t));
    const vmask<float> lanes_again = from_bits<float>(again);
    hits.t = select(lanes_again, start.second.t, hits.t);
    hits.point = select(lanes_again, narrow(low, high), hits.point);
    for_each_distinct<float>(
        start.second.surface, again, [&](std::int32_t number, vmask<float> same) {
            const abi::SurfaceIndex& index = shapes.index[number];
            const Vec3v<float> normal =
                narrow(surface_normal<double>(shapes, index, low, low_dir),
                       surface_normal<double>(shapes, index, high, high_dir));
            hits.normal = select(from_bits<float>(bits(same) & again), normal, hits.normal);
        });
}

/// Of the lanes of `active`, which are on more than one surface: all spheres together.
template <Refine R>
[[gnu::noinline]] std::uint32_t refine_mixed(RefinedHits<float>& hits,
                                             const abi::ShapesView& shapes,
                                             const RayPacket<float>& rays,
                                             const vint<float>& surface, std::uint32_t active)
{
    const WideRays wide(rays);
    SphereForm spheres = form_of(abi::SphereShape{{0, 0, 0}, 1});
    std::uint32_t on_spheres = 0;
    std::uint32_t done = 0;
    for_each_distinct<float>(surface, active, [&](std::int32_t number, const vmask<float>& mask) {
        const abi::SurfaceIndex& index = shapes.index[number];
        const std::uint32_t same = bits(mask) & active;
        if (index.kind == abi::SurfaceKind::sphere) {
            spheres = blended(spheres, shapes.spheres[index.record], same);
            on_spheres |= same;
        } else {
            done |= refine_by_newton<R>(hits, shapes, index, rays, wide, same);
        }
    });
    if (on_spheres != 0)
        done |= refine_by_newton<R>(hits, spheres, rays, wide, on_spheres);
    return done;
}

/// The places of the hits of `active` on surfaces that their rays don't start on.
template <Refine R>
inline void refine_others(RefinedHits<float>& hits, const abi::ShapesView& shapes,
                          const RayPacket<float>& rays, const vint<float>& surface,
                          std::uint32_t active)
{
    DistinctNumbers<float> distinct(surface, active);
    const abi::SurfaceIndex& index = shapes.index[distinct.value()];
    const std::uint32_t same = bits(distinct.lanes_of()) & active;
    std::uint32_t left = active;
    if (same == active)
        left &= ~refine_by_newton<R>(hits, shapes, index, rays, WideRays(rays), active);
    else
        left &= ~refine_mixed<R>(hits, shapes, rays, surface, active);
    for_each_distinct<float>(surface, left, [&](std::int32_t number, const vmask<float>& lanes_of) {
        solve_in_double(hits, shapes, shapes.index[number], rays, bits(lanes_of) & left);
    });
}

/// The places of the hits of `active`. Those on a ray's own body are where its start says.
template <abi::Features F, Refine R, class Real>
inline RefinedHits<Real> refined(const abi::ShapesView& shapes, const RayPacket<Real>& rays,
                                 const HitPacket<Real>& hit, const StartPacket<Real>& start,
                                 std::uint32_t active)
{
    RefinedHits<Real> hits;
    hits.t = hit.t;
    hits.point = hits.normal = rays.dir;
    if constexpr (F.exact) {
        const std::uint32_t again = bits(int_equal(hit.surface, start.second.surface)) & active;
        if (active != again)
            refine_others<R>(hits, shapes, rays, hit.surface, active & ~again);
        if constexpr (R == Refine::t)
            hits.t = select(from_bits<Real>(again), start.second.t, hits.t);
        else if (again != 0)
            refine_second(hits, shapes, start, rays, again);
    } else {
        const auto again = int_equal(hit.surface, start.second.surface);
        hits.t = select(again, start.second.t, hit.t);
        if constexpr (R == Refine::place) {
            hits.point = madd<Real>(hits.t, rays.dir, select(again, start.point, rays.org));
            for_each_distinct<Real>(
                hit.surface, active, [&](lane_int<Real> number, vmask<Real> same) {
                    hits.normal = select(
                        same,
                        surface_normal<Real>(shapes, shapes.index[number], hits.point, rays.dir),
                        hits.normal);
                });
        }
    }
    return hits;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
