#pragma once

#include "kernels/geometry/quadric.hpp"

// The point and normal of a hit on a quadric. The shape in double is the record itself.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Transforms a covector from canonical space to the world.
template <class Real>
inline Vec3v<Real> apply_transposed(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& g)
{
    return madd<Real>(g.x, broadcast_as<Real>(quadric.inverse[0]),
                      madd<Real>(g.y, broadcast_as<Real>(quadric.inverse[1]),
                                 scale<Real>(g.z, broadcast_as<Real>(quadric.inverse[2]))));
}

/// The gradient of two planes that intersect: the gradient of one of the planes, and no direction
/// between, however close to their edge. There |s_i| x_i² = |s_j| x_j².
template <class Real>
inline Vec3v<Real> plane_gradient(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& p)
{
    const auto component = [](double s, const vreal<Real>& x) {
        const vreal<Real> size(static_cast<Real>(__builtin_sqrt(s < 0 ? -s : s)));
        const vreal<Real> g = with_sign_of(size, s < 0 ? negated(x) : x);
        return select(x == vreal<Real>(Real(0)), x, g);
    };
    return apply_transposed<Real>(
        quadric, {component(quadric.square[0], p.x), component(quadric.square[1], p.y),
                  component(quadric.square[2], p.z)});
}

/// The gradient of the side at a point in canonical space.
template <class Real>
inline Vec3v<Real> side_gradient(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& p)
{
    if (crossing_planes(quadric))
        return plane_gradient<Real>(quadric, p);
    Vec3v<Real> g = broadcast_as<Real>(quadric.square) * p;
    g.z = g.z + vreal<Real>(static_cast<Real>(quadric.linear));
    return apply_transposed<Real>(quadric, g);
}

/// The same at a point in world space.
template <class Real>
inline Vec3v<Real> side_gradient_at(const abi::QuadricRecord<double>& quadric,
                                    const Vec3v<Real>& point)
{
    return side_gradient<Real>(
        quadric, apply_inverse_as<Real>(quadric, point - broadcast_as<Real>(quadric.center)));
}

template <class Real>
inline Vec3v<Real> cap_gradient(const abi::QuadricRecord<double>& quadric, bool high)
{
    const vreal<Real> sign(high ? Real(1) : Real(-1));
    return scale<Real>(sign, broadcast_as<Real>(quadric.clip));
}

/// Piece 0 is the side, 1 the low cap and 2 the high cap.
template <class Real>
inline Vec3v<Real> unit_normal(const abi::QuadricRecord<double>& quadric, unsigned piece,
                               const Vec3v<Real>& point, const Vec3v<Real>& dir)
{
    return unit_or_against<Real>(piece == 0 ? side_gradient_at<Real>(quadric, point)
                                            : cap_gradient<Real>(quadric, piece == 2),
                                 dir);
}

/// The height of a point over a piece. Infinite for two planes that intersect, except on them,
/// because their gradient is not that of one equation; the sign is right.
inline vreal<double> height_over(const abi::QuadricRecord<double>& quadric, unsigned piece,
                                 const Vec3v<double>& point)
{
    if (piece != 0) {
        const vreal<double> height =
            dot(broadcast(quadric.clip), point - broadcast(quadric.clip_base));
        const vreal<double> inverse(1.0 / quadric.clip_size);
        return inverse * (piece == 2 ? height - vreal<double>(quadric.clip_high)
                                     : vreal<double>(quadric.clip_low) - height);
    }
    const Vec3v<double> p = apply_inverse(quadric, point - broadcast(quadric.center));
    const vreal<double> value = quadric_value<double>(quadric, p);
    if (crossing_planes(quadric))
        return vreal<double>(__builtin_inf()) * value;
    const Vec3v<double> gradient = side_gradient<double>(quadric, p);
    return vreal<double>(0.5) * value / sqrt(dot(gradient, gradient));
}

/// The rounding error of a residual, as a share of its terms.
constexpr double residual_slack = 0x1p-50;

/// A root of the side, improved by one Newton step: for rays nearly parallel to the surface the
/// discriminant loses digits that the equation keeps. The step is taken only if it leads to no
/// other root, and if the residual is larger than its rounding error. The residual is that of the
/// point p + t v itself. From a start far from the hit, as the point closest to the centre is on
/// long hyperboloids, its terms would be larger and lose more digits than the step gains.
inline vreal<double> bettered(const abi::QuadricRecord<double>& quadric, const Vec3v<double>& p,
                              const Vec3v<double>& v, const vreal<double>& t,
                              const vreal<double>& t_min)
{
    const Vec3v<double> square = broadcast(quadric.square);
    const Vec3v<double> at = madd<double>(t, v, p);
    const vreal<double> value = quadric_value<double>(quadric, at);
    const vreal<double> slope = madd(vreal<double>(quadric.linear), v.z, dot(square * at, v));
    const vreal<double> better = t - value / (slope + slope);
    const vreal<double> a = dot(square * v, v);
    const auto near = abs(a * (better - t)) <= vreal<double>(0x1p-11) * abs(slope);
    const auto tells = abs(value) > vreal<double>(residual_slack) * value_size<double>(quadric, at);
    return select(near & tells & (better > t_min), better, t);
}

/// The first hit with one piece.
[[gnu::noinline]] inline RefinedHalf refine(const abi::QuadricRecord<double>& quadric,
                                            unsigned wanted, const RayPacket<double>& rays)
{
    vreal<double> first(__builtin_inf());
    const QuadricOrigin<double> origin = quadric_origin<double>(quadric, rays.org);
    visit_crossings(quadric, origin, rays,
                    [&](vmask<double> valid, const vreal<double>& t, int piece) {
                        if (piece == static_cast<int>(wanted))
                            first = select(valid & (t > rays.t_min) & (t < first), t, first);
                    });
    const Vec3v<double> v = apply_inverse(quadric, rays.dir);
    if (wanted == 0)
        first = bettered(quadric, origin.p, v, first, rays.t_min);
    RefinedHalf hit;
    hit.t = first;
    hit.point = point_at(rays, first);
    const Vec3v<double> gradient =
        wanted == 0 ? side_gradient<double>(quadric, madd<double>(first, v, origin.p))
                    : cap_gradient<double>(quadric, wanted == 2);
    hit.normal = unit_or_against<double>(gradient, rays.dir);
    return hit;
}

/// A piece of a quadric, for one Newton step from the root next to the one that the search found.
struct QuadricForm {
    static constexpr bool root_is_known = true;

    const abi::QuadricRecord<double>& quadric;
    unsigned piece;
    vreal<float> found;
};

/// The gradient of two planes that intersect is not that of a polynomial.
inline bool has_form(const abi::QuadricRecord<double>& quadric, unsigned piece)
{
    return piece != 0 || !crossing_planes(quadric);
}

inline QuadricForm form_of(const abi::QuadricRecord<double>& quadric, unsigned piece,
                           const vreal<float>& found)
{
    return {quadric, piece, found};
}

/// A ray's origin in canonical space, in single precision.
inline Vec3v<float> rough_origin(const abi::QuadricRecord<double>& quadric, const Vec3v<float>& org)
{
    float high[3];
    float low[3];
    for (int axis = 0; axis < 3; ++axis) {
        high[axis] = static_cast<float>(quadric.center[axis]);
        low[axis] = static_cast<float>(quadric.center[axis] - double{high[axis]});
    }
    return apply_inverse_as<float>(quadric, from_place<float>(org, high, low));
}

/// The side's root closest to the one that the search found. It depends on the ray and the quadric
/// only, so a Newton step from it has the same bits whichever search found the hit, in either
/// precision. NaN where the other root is not much further away. Caps are found in double only, so
/// the root that the search found is used as it is.
inline RoughRoot rough_root(const QuadricForm& form, const RayPacket<float>& rays)
{
    if (form.piece != 0)
        return {form.found, vreal<float>(0.0f)};
    const abi::QuadricRecord<double>& quadric = form.quadric;
    const Vec3v<float> p = rough_origin(quadric, rays.org);
    const Vec3v<float> v = apply_inverse_as<float>(quadric, rays.dir);
    const Vec3v<float> scaled = rough(quadric.square) * v;
    const vreal<float> a = dot(scaled, v);
    const vreal<float> b = madd(rough(quadric.linear), v.z, dot(scaled, p));
    const vreal<float> discriminant = quadric_discriminant<float>(quadric, cross(p, v), v, a);
    const vreal<float> inverse = vreal<float>(1.0f) / a;
    const vreal<float> middle = negated(b) * inverse;
    const vreal<float> half = abs(sqrt(max(discriminant, vreal<float>(0.0f))) * inverse);
    const vreal<float> t = select(form.found < middle, middle - half, middle + half);
    const auto next = abs(t - form.found) <= vreal<float>(0.5f) * half;
    return {select(next, t, vreal<float>(__builtin_nanf(""))), a};
}

/// The residual of half a packet in double, and the magnitude of its terms.
struct WideResidual {
    vreal<double> value;
    vreal<double> size;
    vreal<double> slope;
    Vec3v<double> gradient;
};

inline WideResidual residual(const QuadricForm& form, const Vec3v<double>& org,
                             const Vec3v<double>& dir, const vreal<double>& t)
{
    const abi::QuadricRecord<double>& quadric = form.quadric;
    if (form.piece != 0) {
        const bool high = form.piece == 2;
        const double offset = high ? -quadric.clip_high : quadric.clip_low;
        const Vec3v<double> gradient = cap_gradient<double>(quadric, high);
        const Vec3v<double> w = from_base(org, dir, t, broadcast(quadric.clip_base));
        const vreal<double> value = dot(gradient, w) + vreal<double>(offset);
        return {value + value, vreal<double>(0.0), dot(gradient, dir), gradient};
    }
    const Vec3v<double> p =
        apply_inverse(quadric, from_base(org, dir, t, broadcast(quadric.center)));
    const Vec3v<double> gradient = side_gradient<double>(quadric, p);
    return {quadric_value<double>(quadric, p), value_size<double>(quadric, p), dot(gradient, dir),
            gradient};
}

/// With a residual that is off by residual_slack, a Newton step is off by 2^-29 of t if the
/// magnitude of the residual's terms is at most this times the slope and t.
constexpr float largest_size = 0x1p22f;

/// Returns a NaN slope, so that no step is taken, where too little of the residual but rounding
/// error is left, and where the square of the gradient leaves the range of single precision.
inline Residual residual(const QuadricForm& form, const WideRays& rays, const vreal<float>& t)
{
    const WideResidual low = residual(form, rays.org.low, rays.dir.low, widen_low(t));
    const WideResidual high = residual(form, rays.org.high, rays.dir.high, widen_high(t));
    const Vec3v<float> gradient = narrow(low.gradient, high.gradient);
    const vreal<float> size2 = dot(gradient, gradient);
    const vreal<float> slope = narrow(low.slope, high.slope);
    const auto fits = (size2 > vreal<float>(1e-30f)) & (size2 < vreal<float>(1e30f)) &
                      (narrow(low.size, high.size) <= vreal<float>(largest_size) * abs(slope * t));
    return {narrow(low.value, high.value), select(fits, slope, vreal<float>(__builtin_nanf(""))),
            gradient};
}

/// Lanes in which single precision suffices for the change of the gradient over a step of `dt`: the
/// terms of the change, which may cancel, are far smaller than the gradient.
inline vmask<float> turns_little(const QuadricForm& form, const Vec3v<float>& gradient,
                                 const RayPacket<float>& rays, const vreal<float>& dt)
{
    const auto bend = static_cast<float>(8.0 * form.quadric.bend_size);
    const vreal<float> turn = vreal<float>(bend) * dt;
    return turn * turn * rays.dir2 <= dot(gradient, gradient);
}

/// The unit normal at a `step` from the point of the gradient.
inline Vec3v<float> normal_of(const QuadricForm& form, const Vec3v<float>& gradient,
                              const Vec3v<float>& step)
{
    Vec3v<float> at = gradient;
    if (form.piece == 0)
        at = at + apply_transposed<float>(
                      form.quadric,
                      rough(form.quadric.square) * apply_inverse_as<float>(form.quadric, step));
    return scale<float>(vreal<float>(1.0f) / sqrt(dot(at, at)), at);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
