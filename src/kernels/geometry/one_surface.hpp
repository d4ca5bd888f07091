#pragma once

#include "kernels/geometry/quadratic.hpp"

#include <limits>

// The hit of a ray with one known surface: its point in double, the rough root that one Newton step
// improves, and where a ray that starts on the surface hits it again.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real, class Stored>
inline Vec3v<Real> broadcast_as(const Stored (&v)[3])
{
    return {vreal<Real>(static_cast<Real>(v[0])), vreal<Real>(static_cast<Real>(v[1])),
            vreal<Real>(static_cast<Real>(v[2]))};
}

/// The gradient scaled to length 1. Where it vanishes, as in a cone's apex or where planes
/// intersect, the direction against the ray.
template <class Real>
inline Vec3v<Real> unit_or_against(const Vec3v<Real>& gradient, const Vec3v<Real>& dir)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> one(Real(1));
    const auto vanishes = !(dot(gradient, gradient) > zero);
    const Vec3v<Real> against{negated(dir.x), negated(dir.y), negated(dir.z)};
    const Vec3v<Real> any = select(vanishes, against, gradient);
    return scale<Real>(one / sqrt(dot(any, any)), any);
}

/// Half a packet of hits, with the values that shading needs.
struct RefinedHalf {
    vreal<double> t;
    Vec3v<double> point;
    Vec3v<double> normal;
};

inline Vec3v<double> point_at(const RayPacket<double>& rays, const vreal<double>& t)
{
    return madd<double>(t, rays.dir, rays.org);
}

/// The first root beyond t_min. A ray that misses the surface by rounding in double counts as
/// touching it.
inline vreal<double> first_root(const Quadratic<double>& quadratic, const vreal<double>& t_min)
{
    const vreal<double> root =
        with_sign_of(sqrt(max(quadratic.discriminant, vreal<double>(0.0))), quadratic.b);
    const vreal<double> minus_q = quadratic.b + root;
    const vreal<double> first = lesser_root(quadratic, root, minus_q, all_lanes<double>);
    // For t_min >= 0 this is the first root that can be beyond t_min.
    const auto counts = first > t_min;
    if (all(counts))
        return first;
    return select(counts, first, negated(minus_q) / quadratic.a);
}

/// One value for each half of a packet of floats.
template <class Value>
struct BothHalves {
    Value low, high;
};

inline BothHalves<Vec3v<double>> widen(const Vec3v<float>& v)
{
    return {widen_low(v), widen_high(v)};
}

inline vreal<float> rough(double x)
{
    return vreal<float>(static_cast<float>(x));
}
inline Vec3v<float> rough(const double (&v)[3])
{
    return broadcast_as<float>(v);
}

/// A root in single precision: the first beyond t_min, up to rounding.
struct RoughRoot {
    vreal<float> t;
    vreal<float> bend;  ///< half the second derivative along the ray
};

/// The residual of the surface's equation at t, half its derivative along the ray, and half its
/// gradient.
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

/// The equation of anchored spheres and, with curvature 0, planes: (g + n)·w + offset = 0 for g = n
/// + curvature w.
struct AnchoredForm {
    static constexpr bool root_is_known = false;

    BothHalves<Vec3v<double>> base;
    Vec3v<double> normal;
    vreal<double> curvature;
    vreal<double> offset;
    Vec3v<float> rough_base;
    Vec3v<float> rough_normal;
    vreal<float> rough_curvature;
    vreal<float> rough_offset;
};

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

inline Vec3v<float> normal_of(const AnchoredForm& form, const Vec3v<float>& gradient,
                              const Vec3v<float>& step)
{
    return madd<float>(form.rough_curvature, step, gradient);
}

/// From which side a ray may leave a surface and hit it again.
enum class HitAgain { never, from_inside, from_anywhere };

/// A surface's equation along a line from a point on it: 2 slope t + bend t² = 0.
struct SurfaceLine {
    vreal<double> slope, bend;
};

/// Where the rays of half a packet hit again the object that they start on, and the lanes that hit
/// it in a cap.
struct OwnCrossing {
    vreal<double> t;  ///< infinite if they do not
    std::uint32_t low_cap = 0;
    std::uint32_t high_cap = 0;
};

/// The smallest t that counts as beyond the start.
inline vreal<double> at_once()
{
    return vreal<double>(std::numeric_limits<double>::min());
}

/// The other root of `line`. The sign of the slope is taken from the side that the rays leave on,
/// so that rounding cannot flip it for grazing rays. Negative or NaN if there is no root ahead.
inline vreal<double> other_root(const SurfaceLine& line, vmask<double> outside)
{
    const vreal<double> twice = abs(line.slope) + abs(line.slope);
    return select(outside, negated(twice), twice) / line.bend;
}

/// The hit at the other root, for a surface that is the object's only piece.
inline OwnCrossing only_crossing(const vreal<double>& root, const vreal<double>& bend,
                                 const vreal<double>& t_min, vmask<double> outside)
{
    const vreal<double> never(__builtin_inf());
    // A ray that runs along the surface on its inner side leaves a surface that bends away from it
    // at once.
    const std::uint32_t inwards = ~bits(outside) & bits(bend > vreal<double>(0.0));
    const std::uint32_t ahead = inwards | bits(root > vreal<double>(0.0));
    const vreal<double> t = max(root, at_once());
    return {select(from_bits<double>(ahead & bits(t > t_min) & bits(t < never)), t, never)};
}

inline OwnCrossing only_crossing(const SurfaceLine& line, const vreal<double>& t_min,
                                 vmask<double> outside)
{
    return only_crossing(other_root(line, outside), line.bend, t_min, outside);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
