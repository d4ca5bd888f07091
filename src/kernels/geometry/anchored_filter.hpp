#pragma once

#include "kernels/geometry/anchored_sphere.hpp"
#include "kernels/geometry/filter.hpp"

// Tests of anchored spheres with error bounds, in single precision. Each set of rays gets its own
// anchor, the surface point nearest to the rays' origins, so that the terms of the equation are as
// small as possible.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// An anchored sphere for a set of ray origins. With p = o - anchor and g = n + k p: F(t) = k a t²
/// + 2 (g·d) t + F(0), F(0) = (g + n)·p + k0.
struct AnchoredFilter {
    float anchor[3];
    float normal[3];
    float curvature;
    float offset;
    // For a shared origin, rounded once from double.
    float gradient[3];
    float value;
    // Upper bounds of errors: of b = g·d per |d|, of F(0), and of the discriminant per d·d.
    float slope_error;
    float value_error;
    float discriminant_error;
    std::int32_t surface;
};

inline double length_of(const double (&v)[3])
{
    return __builtin_sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

inline float above(double x)
{
    return static_cast<float>(x) * (1.0f + 4.0f * roundoff);
}

/// Error bounds as derived in docs/numerics_derivations.md; `distance` is the largest |p|.
inline void set_anchored_errors(AnchoredFilter& filter, double distance, Origin origin)
{
    constexpr double u = roundoff * inflation;
    const double fused = product_roundings;
    const double k = filter.curvature;
    const double value = filter.value < 0 ? -double{filter.value} : double{filter.value};
    const double offset = filter.offset < 0 ? -double{filter.offset} : double{filter.offset};
    const double size = 1.0 + k * distance;
    const double gradient = (origin == Origin::shared ? 1.0 : 3.2) * fused * u * size;
    const double constant = origin == Origin::shared
                                ? 1.1 * u * value + 1e-13 * (size + 1.0) * distance + 1e-15 / k
                                : fused * 10.7 * u * (size + 1.0) * distance + 2.1 * u * offset;
    const double slope = gradient + fused * 3.2 * u * size;
    // With more than one origin, F(0) may be anything up to this.
    const double most_value = origin == Origin::shared ? value : (size + 1.0) * distance + offset;
    filter.slope_error = above(slope);
    filter.value_error = above(constant);
    filter.discriminant_error =
        above(2.0 * size * slope + k * constant + fused * 7.0 * u * k * most_value +
              fused * 2.0 * u * size * size);
}

template <Origin O>
[[gnu::noinline]] AnchoredFilter anchored_filter(const abi::AnchoredSphere<double>& sphere,
                                                 const Origins& origins)
{
    AnchoredFilter filter{};
    double out[3];
    for (int axis = 0; axis < 3; ++axis)
        out[axis] = double{origins.center[axis]} - sphere.center[axis];
    double distance = length_of(out);
    if (!(distance > 0)) {
        out[1] = distance = 1.0;
    }
    double anchor[3];
    double p[3];
    for (int axis = 0; axis < 3; ++axis) {
        filter.anchor[axis] =
            static_cast<float>(sphere.center[axis] + out[axis] * (sphere.radius / distance));
        anchor[axis] = double{filter.anchor[axis]} - sphere.center[axis];
        p[axis] = double{origins.center[axis]} - double{filter.anchor[axis]};
    }
    const double to_anchor = length_of(anchor);
    const double k0 = (to_anchor - sphere.radius) * (to_anchor + sphere.radius) / sphere.radius;
    const double k = 1.0 / sphere.radius;
    double value = k0;
    for (int axis = 0; axis < 3; ++axis) {
        const double n = anchor[axis] * k;
        const double g = n + k * p[axis];
        filter.normal[axis] = static_cast<float>(n);
        filter.gradient[axis] = static_cast<float>(g);
        value += (g + n) * p[axis];
    }
    filter.curvature = static_cast<float>(k);
    filter.offset = static_cast<float>(k0);
    filter.value = static_cast<float>(value);
    filter.surface = sphere.surface;
    set_anchored_errors(filter, length_of(p) * 1.000001 + double{origins.radius}, O);
    return filter;
}

/// F along the rays: F(t) = bend t² + 2 b t + value.
struct AnchoredLine {
    vreal<float> b;
    vreal<float> value;
    vreal<float> bend;  ///< k a
    vreal<float> discriminant;
    vreal<float> slope_error;
    vreal<float> discriminant_error;
    vreal<float> value_error;
};

template <Origin O>
inline AnchoredLine line_of(const AnchoredFilter& filter, const RayPacket<float>& rays,
                            const RayScale& scale)
{
    AnchoredLine line;
    const vreal<float> curvature(filter.curvature);
    if constexpr (O == Origin::shared) {
        line.b = dot(broadcast(filter.gradient), rays.dir);
        line.value = vreal<float>(filter.value);
    } else {
        const Vec3v<float> p = rays.org - broadcast(filter.anchor);
        const Vec3v<float> n = broadcast(filter.normal);
        const Vec3v<float> g = madd<float>(curvature, p, n);
        line.b = dot(g, rays.dir);
        line.value = dot(g + n, p) + vreal<float>(filter.offset);
    }
    line.bend = curvature * rays.dir2;
    line.discriminant = msub(line.b, line.b, line.bend * line.value);
    line.slope_error = vreal<float>(filter.slope_error) * scale.length;
    line.discriminant_error = vreal<float>(filter.discriminant_error) * rays.dir2;
    line.value_error = vreal<float>(filter.value_error);
    return line;
}

/// Lanes whose rays start outside and stay outside up to t_end: they either leave the surface, or
/// still approach it at t_end and are outside there. This suffices because F is convex.
inline vmask<float> stays_above(const AnchoredLine& line, const vreal<float>& t_end)
{
    const vreal<float> last_slope = madd(line.bend, t_end, line.b);
    const vreal<float> climb = t_end * (line.b + last_slope);
    const vreal<float> rounding = vreal<float>(roundoffs(8.0f)) * (line.value - climb);
    const vreal<float> error = madd(t_end + t_end, line.slope_error, line.value_error + rounding);
    const vmask<float> outside = line.value > line.value_error;
    const vmask<float> towards = last_slope < negated(line.slope_error + line.slope_error);
    return outside & ((line.b > line.slope_error) | (towards & (line.value + climb > error)));
}

/// The first hit of a line with an anchored sphere: from inside its only root ahead, from outside
/// the first of two.
struct AnchoredHit {
    vreal<float> t;
    vreal<float> error;
    vmask<float> sure;     ///< lanes that certainly have a first root ahead
    vmask<float> nothing;  ///< lanes that certainly have none
};

/// The error of a root, as a share of t, besides that of its terms.
inline constexpr float error_per_t = roundoffs(20.0f);

/// Replaces the hits of rays from inside against the gradient, `by_sum`, by the other root.
inline void set_other_root(AnchoredHit& hit, const AnchoredLine& line, vmask<float> by_sum,
                           const vreal<float>& sum, const vreal<float>& sum_error)
{
    const vreal<float> inverse_bend = vreal<float>(1.0f) / line.bend;
    const vreal<float> other = sum * inverse_bend;
    hit.t = select(by_sum, other, hit.t);
    hit.error = select(
        by_sum,
        madd(sum_error, inverse_bend * vreal<float>(1.5f), other * vreal<float>(error_per_t)),
        hit.error);
}

inline AnchoredHit first_root(const AnchoredLine& line)
{
    const vreal<float> zero(0.0f);
    const vmask<float> outside = line.value > line.value_error;
    const vmask<float> inside = line.value < negated(line.value_error);
    const vmask<float> towards = line.b < negated(line.slope_error);
    const vmask<float> away = line.b > line.slope_error;
    const vmask<float> crosses =
        line.discriminant > line.discriminant_error + line.discriminant_error;
    const vmask<float> misses = line.discriminant < negated(line.discriminant_error);
    AnchoredHit hit;
    hit.sure = crosses & ((outside & towards) | inside);
    hit.nothing = misses | (outside & away);
    if (bits(hit.nothing) == all_lanes<float>)
        return hit;

    const vreal<float> inverse_root =
        rough_inverse_sqrt(max(line.discriminant, vreal<float>(1e-30f)));
    const vreal<float> root = line.discriminant * inverse_root;
    const vreal<float> sum = root + abs(line.b);
    const vreal<float> sum_error =
        madd(vreal<float>(0.6f) * inverse_root, line.discriminant_error, line.slope_error);
    // For rays from outside, and for rays from inside along the gradient: F(0) divided by a sum
    // that does not cancel.
    const vmask<float> by_sum = hit.sure & inside & (line.b < zero);
    const vreal<float> inverse = vreal<float>(1.0f) / sum;
    hit.t = abs(line.value) * inverse;
    hit.error = madd(madd(hit.t, sum_error, line.value_error), inverse * vreal<float>(1.5f),
                     hit.t * vreal<float>(error_per_t));
    if (any(by_sum))
        set_other_root(hit, line, by_sum, sum, sum_error);
    return hit;
}

template <Origin O, class Own>
inline void keep_certain(HitPacket<float>& hit, const AnchoredFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const std::uint32_t not_own = own.template lanes_on_others<float>(filter.surface);
    const AnchoredHit at = first_root(line_of<O>(filter, rays, scale));
    const std::uint32_t open = ~bits(at.nothing) & not_own;
    if (open == 0)
        return;
    const vreal<float> low = at.t - at.error;
    const vreal<float> high = at.t + at.error;
    const vmask<float> ahead = at.sure & (low > rays.t_min);
    keep_sure(hit, ahead & from_bits<float>(not_own), low, high, filter.surface);
    const std::uint32_t rest = open & ~bits(ahead);
    if (rest != 0)
        keep_doubt(hit, from_bits<float>(rest),
                   select(at.sure, low, vreal<float>(-__builtin_inff())), bits(at.sure));
}

template <Origin O, class Own>
inline Occlusion occludes(const AnchoredFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own&)
{
    const AnchoredLine line = line_of<O>(filter, rays, scale);
    const vmask<float> above = stays_above(line, t_end);
    if (bits(above) == all_lanes<float>)
        return {};
    const AnchoredHit at = first_root(line);
    const std::uint32_t open = ~bits(at.nothing | above) & all_lanes<float>;
    if (open == 0)
        return {};
    const vreal<float> low = at.t - at.error;
    const vreal<float> high = at.t + at.error;
    // Whether the first hit lies in the ray interval is certain only if the first root is.
    const vmask<float> first = at.sure & (low > rays.t_min);
    const std::uint32_t blocked = open & bits(first & (high < t_end));
    const std::uint32_t behind = bits(first & (low > t_end));
    const std::uint32_t unsure = open & ~blocked & ~behind;
    note_in_the_way(unsure & bits(at.sure), abi::Cause::range);
    note_in_the_way(unsure & ~bits(at.sure), abi::Cause::tangent);
    return {blocked, unsure};
}

template <Origin O>
inline AnchoredFilter certain_form(const abi::AnchoredSphere<float>&,
                                   const abi::AnchoredSphere<double>& wide, const Origins& origins)
{
    return anchored_filter<O>(wide, origins);
}

/// Whether no ray of a cone hits an anchored sphere. Either all rays stay in front of a plane that
/// touches it, or they start from one point outside and run along its outward gradient.
inline bool leaves_behind(const Cone<float>& cone, const AnchoredFilter& sphere)
{
    const float inwards[3] = {-sphere.gradient[0], -sphere.gradient[1], -sphere.gradient[2]};
    return stays_in_front(cone, sphere.anchor, sphere.normal) ||
           (cone.radius == 0 && sphere.value > sphere.value_error && runs_against(cone, inwards));
}

/// The kind, see kinds.hpp.
struct AnchoredSphere : KindOf<abi::Primitive::anchored_sphere, abi::SurfaceKind::anchored_sphere> {
    template <class Real>
    using FromPoint = ObjectArray<SharedOriginAnchored<Real>>;
    template <class Real>
    using Selected = SelectedRecords<abi::AnchoredSphere<Real>>;
    using Certain = ObjectArray<AnchoredFilter>;

    template <class Real>
    static const auto& list(const abi::GeometryView<Real>& scene)
    {
        return scene.anchored_spheres;
    }
    static const auto* shapes(const abi::ShapesView& shapes)
    {
        return shapes.anchored_spheres;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
