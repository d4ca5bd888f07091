#pragma once

#include "kernel_abi/features.hpp"
#include "kernels/precision/leave_surface.hpp"

// Hits in the precision that shading and callers need. The search only decides which surface a ray
// hits first. Then the first root beyond t_min of that one surface is computed, so t, point and
// normal depend only on the ray and the surface, not on how the surface was found. A root in single
// precision is improved by one Newton step with a residual in double. Where that does not suffice,
// the equation is solved in double.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Which values of a hit are computed: t only, or also point and normal.
enum class Refine { t, place };

/// A packet of refined hits: t, point and normal, or t only.
template <class Real, Refine R = Refine::place>
struct RefinedHits {
    vreal<Real> t;
    Vec3v<Real> point;
    Vec3v<Real> normal;  ///< outwards and unit
};
template <class Real>
struct RefinedHits<Real, Refine::t> {
    vreal<Real> t;
};

inline RefinedHalf refine_half(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                               const RayPacket<double>& rays)
{
    return with_shape(shapes, index, [&](const auto& shape, unsigned piece) {
        return refine(shape, piece, rays);
    });
}

/// Lanes that enter the surface (`slope` is negative, `bend` is not) and for which the Newton step
/// from `t` certainly suffices. is_enough() is true for these lanes too, and for others.
inline std::uint32_t is_surely_enough(const vreal<float>& t, const vreal<float>& bend,
                                      const vreal<float>& slope, const vreal<float>& dt,
                                      const vreal<float>& t_min)
{
    const vreal<float> size = abs(dt);
    const vreal<float> bent = bend * size;
    return bits((bent < vreal<float>(-0x1p-12f) * slope) &
                (bent * size <= vreal<float>(-0x1p-31f) * t * slope) &
                (size <= vreal<float>(0x1p-10f) * t) & (t > vreal<float>(1.01f) * t_min));
}

/// Lanes in which t + dt is within 2^-30 of a root and beyond t_min. A Newton step of dt leaves an
/// error of bend dt² / slope / 2.
inline vmask<float> is_close(const RoughRoot& root, const vreal<float>& slope,
                             const vreal<float>& dt, const vreal<float>& t_min)
{
    const vreal<float> size = abs(dt);
    const vreal<float> steep = abs(slope);
    const vreal<float> bent = abs(root.bend) * size;
    return (bent <= vreal<float>(0x1p-11f) * steep) &
           (bent * size <= vreal<float>(0x1p-30f) * (steep * root.t)) &
           (size <= vreal<float>(0x1p-9f) * root.t) & (root.t + dt > t_min);
}

/// Lanes in which that is the root that the search found, where `root` is the one closest to it.
/// The t of the search is off by at most four roundoffs, and the other root is much further away. A
/// smaller t may be off by more.
inline vmask<float> is_found(const RoughRoot& root, const vreal<float>& slope,
                             const vreal<float>& dt, const vreal<float>& t_min)
{
    return is_close(root, slope, dt, t_min) &
           (abs(root.bend) * root.t <= vreal<float>(0x1p18f) * abs(slope)) &
           (root.t > vreal<float>(1e-30f));
}

/// The lanes of `same` in which that is the first root beyond t_min; bends are not negative.
inline std::uint32_t is_enough(const RoughRoot& root, const vreal<float>& slope,
                               const vreal<float>& dt, const vreal<float>& t_min,
                               std::uint32_t same)
{
    if ((same & ~is_surely_enough(root.t, root.bend, slope, dt, t_min)) == 0)
        return same;
    const auto close = is_close(root, slope, dt, t_min);
    // A ray that leaves the surface must have entered it before t_min. The roots are centred slope
    // / bend before t, so the other root is dt + 2 slope / bend before.
    const vreal<float> since =
        madd(root.bend, (root.t - dt) - t_min, vreal<float>(0x1p-22f) * (root.bend * root.t));
    const auto first =
        (slope < vreal<float>(0.0f)) | (vreal<float>(2.0f - 0x1p-18f) * slope > since);
    return same & bits(close & first);
}

/// Refines the lanes of `same`, whose surfaces are `form`. Returns the lanes for which a Newton
/// step sufficed.
template <Refine R, class Form>
inline std::uint32_t refine_by_newton(RefinedHits<float, R>& hits, const Form& form,
                                      const RayPacket<float>& rays, std::uint32_t same)
{
    const RoughRoot root = rough_root(form, rays);
    // Widened here, because values widened before the kind of surface is known would be spilled to
    // memory.
    const WideRays wide(rays);
    const Residual at = residual(form, wide, root.t);
    vreal<float> dt = vreal<float>(-0.5f) * at.value / at.slope;
    std::uint32_t done;
    if constexpr (Form::root_is_known) {
        // The second-order term of the step, for points on long rays.
        dt = madd(vreal<float>(-0.5f) * dt / at.slope, root.bend * dt, dt);
        done = same & bits(is_found(root, at.slope, dt, rays.t_min) &
                           turns_little(form, at.gradient, rays, dt));
    } else {
        done = is_enough(root, at.slope, dt, rays.t_min, same);
    }
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

/// The same for any kind of surface. All lanes of `same` are on one surface, which the search found
/// at `found`.
template <Refine R>
inline std::uint32_t refine_by_newton(RefinedHits<float, R>& hits, const abi::ShapesView& shapes,
                                      const abi::SurfaceIndex& index, const RayPacket<float>& rays,
                                      const vreal<float>& found, std::uint32_t same)
{
    return with_shape(shapes, index, [&](const auto& shape, unsigned piece) -> std::uint32_t {
        if constexpr (requires { steep_lanes(shape, rays); })
            return refine_by_newton(hits, form_of(shape), rays, same & steep_lanes(shape, rays));
        else if constexpr (requires { form_of(shape); })
            return refine_by_newton(hits, form_of(shape), rays, same);
        else if constexpr (requires { form_of(shape, piece, found); })
            return has_form(shape, piece)
                       ? refine_by_newton(hits, form_of(shape, piece, found), rays, same)
                       : 0;
        else
            return 0;
    });
}

/// Refines lanes that are all on one surface by solving its equation in double.
template <Refine R>
[[gnu::noinline]] void solve_in_double(RefinedHits<float, R>& hits, const abi::ShapesView& shapes,
                                       const abi::SurfaceIndex& index, const RayPacket<float>& rays,
                                       std::uint32_t lanes_of)
{
    const vmask<float> same = from_bits<float>(lanes_of);
    const RefinedHalf a = refine_half(shapes, index, widen_low(rays));
    const RefinedHalf b = refine_half(shapes, index, widen_high(rays));
    hits.t = select(same, narrow(a.t, b.t), hits.t);
    if constexpr (R == Refine::place) {
        hits.point = select(same, narrow(a.point, b.point), hits.point);
        hits.normal = select(same, narrow(a.normal, b.normal), hits.normal);
    }
}

/// Moves points found along rays onto their surface. The rounding of t leaves them further off the
/// surface than the distance at which surfaces are told apart. They move by at most `most`, the
/// rounding error, so that an apex does not throw them away.
inline Vec3v<double> on_surface(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                const vreal<double>& most, const Vec3v<double>& point,
                                const Vec3v<double>& normal)
{
    if (index.kind == abi::SurfaceKind::none)
        return point;
    const vreal<double> height = with_shape(shapes, index, [&](const auto& shape, unsigned piece) {
        return height_over(shape, piece, point);
    });
    return select(abs(height) <= most, point - scale<double>(height, normal), point);
}

/// Refines hits with the objects that rays start on, whose t is known.
[[gnu::noinline]] inline void refine_second(RefinedHits<float>& hits, const abi::ShapesView& shapes,
                                            const StartPacket<float>& start,
                                            const RayPacket<float>& rays, std::uint32_t again)
{
    const auto half = [&](const Vec3v<double>& from, const Vec3v<double>& dir,
                          const vreal<double>& t) { return madd<double>(t, dir, from); };
    const Vec3v<double> low_dir = widen_low(rays.dir);
    const Vec3v<double> high_dir = widen_high(rays.dir);
    const vreal<double> low_t = widen_low(start.second.t);
    const vreal<double> high_t = widen_high(start.second.t);
    const Vec3v<double> low = half(widen_low(start.point), low_dir, low_t);
    const Vec3v<double> high = half(widen_high(start.point), high_dir, high_t);
    // Twice the rounding error of t.
    const vreal<double> share(0x1p-23);
    const vreal<double> low_most = share * low_t * size_of(low_dir);
    const vreal<double> high_most = share * high_t * size_of(high_dir);
    hits.t = select(from_bits<float>(again), start.second.t, hits.t);
    for_each_distinct<float>(
        start.second.surface, again, [&](std::int32_t number, vmask<float> same) {
            const abi::SurfaceIndex& index = shapes.index[number];
            const vmask<float> lanes_of = from_bits<float>(bits(same) & again);
            const Vec3v<double> low_normal = surface_normal<double>(shapes, index, low, low_dir);
            const Vec3v<double> high_normal = surface_normal<double>(shapes, index, high, high_dir);
            hits.normal = select(lanes_of, narrow(low_normal, high_normal), hits.normal);
            hits.point = select(lanes_of,
                                narrow(on_surface(shapes, index, low_most, low, low_normal),
                                       on_surface(shapes, index, high_most, high, high_normal)),
                                hits.point);
        });
}

/// Refines lanes that are on more than one surface; all spheres are refined together.
template <Refine R>
[[gnu::noinline]] std::uint32_t refine_mixed(RefinedHits<float, R>& hits,
                                             const abi::ShapesView& shapes,
                                             const RayPacket<float>& rays,
                                             const vreal<float>& found, const vint<float>& surface,
                                             std::uint32_t active)
{
    SphereLanes spheres;
    std::uint32_t on_spheres = 0;
    std::uint32_t done = 0;
    for_each_distinct<float>(surface, active, [&](std::int32_t number, const vmask<float>& mask) {
        const abi::SurfaceIndex& index = shapes.index[number];
        const std::uint32_t same = bits(mask) & active;
        if (index.kind == abi::SurfaceKind::sphere) {
            spheres.put(same, shapes.spheres[index.record]);
            on_spheres |= same;
        } else {
            done |= refine_by_newton(hits, shapes, index, rays, found, same);
        }
    });
    if (on_spheres != 0)
        done |= refine_by_newton(hits, spheres.form(), rays, on_spheres);
    return done;
}

/// Refines the hits of `active` on surfaces that their rays do not start on, which the search found
/// at `found`.
template <Refine R>
inline void refine_others(RefinedHits<float, R>& hits, const abi::ShapesView& shapes,
                          const RayPacket<float>& rays, const vreal<float>& found,
                          const vint<float>& surface, std::uint32_t active)
{
    DistinctNumbers<float> distinct(surface, active);
    const abi::SurfaceIndex& index = shapes.index[distinct.value()];
    const std::uint32_t same = bits(distinct.lanes_of()) & active;
    std::uint32_t left = active;
    if (same == active)
        left &= ~refine_by_newton(hits, shapes, index, rays, found, active);
    else
        left &= ~refine_mixed(hits, shapes, rays, found, surface, active);
    for_each_distinct<float>(surface, left, [&](std::int32_t number, const vmask<float>& lanes_of) {
        solve_in_double(hits, shapes, shapes.index[number], rays, bits(lanes_of) & left);
    });
}

/// Points and normals in fast mode and in double: at t as the search found it.
template <class Real>
inline void find_places(RefinedHits<Real>& hits, const abi::ShapesView& shapes,
                        const RayPacket<Real>& rays, const HitPacket<Real>& hit,
                        const StartPacket<Real>& start, std::uint32_t active)
{
    const auto again = int_equal(hit.surface, start.second.surface);
    hits.point = madd<Real>(hits.t, rays.dir, select(again, start.point, rays.org));
    for_each_distinct<Real>(hit.surface, active, [&](lane_int<Real> number, vmask<Real> same) {
        const abi::SurfaceIndex& index = shapes.index[number];
        const Vec3v<Real> normal = surface_normal<Real>(shapes, index, hits.point, rays.dir);
        hits.normal = select(same, normal, hits.normal);
        if constexpr (sizeof(Real) == sizeof(double)) {
            const vreal<double> way = madd(abs(hits.t), size_of(rays.dir), size_of(rays.org));
            hits.point = select(
                same, on_surface(shapes, index, vreal<double>(0x1p-46) * way, hits.point, normal),
                hits.point);
        }
    });
}

/// Refines the hits of `active`. Hits with a ray's own object are taken from its start.
template <abi::Features F, Refine R, class Real>
inline RefinedHits<Real, R> refined(const abi::ShapesView& shapes, const RayPacket<Real>& rays,
                                    const HitPacket<Real>& hit, const StartPacket<Real>& start,
                                    std::uint32_t active)
{
    RefinedHits<Real, R> hits;
    hits.t = hit.t;
    if constexpr (R == Refine::place)
        hits.point = hits.normal = rays.dir;
    if constexpr (F.exact) {
        const std::uint32_t again = bits(int_equal(hit.surface, start.second.surface)) & active;
        if (active != again)
            refine_others(hits, shapes, rays, hit.t, hit.surface, active & ~again);
        if constexpr (R == Refine::t)
            hits.t = select(from_bits<Real>(again), start.second.t, hits.t);
        else if (again != 0)
            refine_second(hits, shapes, start, rays, again);
    } else {
        hits.t = select(int_equal(hit.surface, start.second.surface), start.second.t, hit.t);
        if constexpr (R == Refine::place)
            find_places(hits, shapes, rays, hit, start, active);
    }
    return hits;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
