#pragma once

#include "kernels/geometry/filter.hpp"
#include "kernels/geometry/sphere.hpp"

// Tests of spheres with error bounds, in single precision. For w = o - c, known up to e_w, and the
// moment m = w × d, the error of |m| is at most |d| h + u |m| with h = e_w + u |w|. So a ray with
// |m| above (r + h) |d| certainly misses, and one below (r - h) |d| certainly hits;
// docs/numerics_derivations.md has the proof.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The error bounds of a sphere for a set of ray origins, for one sphere or for one per lane.
/// crossing() adds the part that depends on the distance from the ray's origin to the centre.
template <class Value>
struct SphereBounds {
    Value outer2;  ///< (r + h)², rounded up
    Value inner2;  ///< (r - h)², rounded down; negative for none
    Value along;   ///< of t, times |d|, without the part of a small discriminant
    Value moment;  ///< of |m|, per |d|
    Value size;    ///< twice the radius, rounded up
    Value band2;  ///< upper bound, for a ray between inner and outer, of the square of a quarter of
                  ///< its length in the sphere, times d·d
    Value reach;  ///< upper bound of half the length of a ray in the sphere, plus `along`
};

/// How far rounding may change |m| / |d| for rays whose origins are at most `length` from a centre
/// that is known up to `center_error`.
inline vreal<float> moment_error(const vreal<float>& center_error, const vreal<float>& length)
{
    return madd(vreal<float>(roundoffs(2.4f)), length, center_error);
}

/// `moment` is moment_error() for all rays of the set.
template <class Value>
inline SphereBounds<Value> sphere_bounds(const Value& radius, const Value& center_error,
                                         const Value& moment)
{
    const Value size = radius * Value(1.0f + roundoffs(2.0f));
    const Value outer = size + moment;
    const Value inner = radius * Value(1.0f - roundoffs(2.0f)) - moment;
    SphereBounds<Value> bounds;
    bounds.outer2 = signed_square(outer) * Value(1.0f + roundoffs(16.0f));
    bounds.inner2 = signed_square(inner) * Value(1.0f - roundoffs(16.0f));
    bounds.along = madd(Value(roundoffs(60.0f)), outer, center_error);
    bounds.moment = madd(Value(roundoffs(12.0f)), outer, center_error);
    bounds.size = Value(2.0f * inflation) * size;
    const Value widest = size * Value(1.0f + roundoffs(6.0f));
    bounds.band2 = max(size * (widest - min(inner, size)), Value(0.0f));
    bounds.reach = madd(Value(inflation), max(outer, Value(0.0f)), bounds.along);
    return bounds;
}

/// The error of t, times |d|, of a ray that does not miss with |b| / |d| = `reach`: |w| is at most
/// reach + outer.
template <class Value>
inline Value along_error(const SphereBounds<Value>& bounds, const Value& reach)
{
    return madd(Value(roundoffs(28.0f)), reach, bounds.along);
}

/// The error of |m|, per |d|, times twice the radius. Divided by the discriminant's root it is the
/// error of that root.
template <class Value>
inline Value root_error(const SphereBounds<Value>& bounds, const Value& reach)
{
    return bounds.size * madd(Value(roundoffs(2.6f)), reach, bounds.moment);
}

/// The input of a test of a packet of rays and a sphere, or of a ray and a packet of spheres.
struct SphereTest {
    Vec3v<float> w;  ///< ray origin relative to the centre
    vreal<float> radius2;
    SphereBounds<vreal<float>> bounds;
};

/// Lanes that do not certainly miss, and |m|².
struct SphereApproach {
    vreal<float> moment2;
    std::uint32_t near;
};

inline vreal<float> moment2_of(const Vec3v<float>& w, const RayPacket<float>& rays)
{
    const Vec3v<float> moment = cross(w, rays.dir);
    return dot(moment, moment);
}

inline SphereApproach approach(const Vec3v<float>& w, const vreal<float>& outer2,
                               const RayPacket<float>& rays)
{
    const vreal<float> moment2 = moment2_of(w, rays);
    const std::uint32_t misses = bits(moment2 > outer2 * rays.dir2);
    return {moment2, ~misses & all_lanes<float>};
}

/// The lanes of `near` that may be inside the sphere between t_min and t_end; `reach` is
/// bounds.reach. `middle` is the t at which they are closest to the centre.
inline std::uint32_t may_be_within(std::uint32_t near, const vreal<float>& middle,
                                   const vreal<float>& reach, const RayPacket<float>& rays,
                                   const RayScale& scale, const vreal<float>& t_end)
{
    const vreal<float> half =
        madd(reach, scale.inverse, vreal<float>(roundoffs(28.0f)) * abs(middle));
    return near & ~bits(middle + half < rays.t_min) & ~bits(middle - half > t_end);
}

/// Smaller discriminants count as this, so that their inverse root is finite.
inline constexpr float least_discriminant = 1e-37f;
/// The error of the root of a smaller discriminant.
inline constexpr float least_root_error = 1e-18f;

/// Both roots, in the lanes that certainly hit the sphere.
struct SphereCrossing {
    RootIntervals roots;
    vreal<float> middle;  ///< t at which the ray is closest to the centre
    vreal<float> along;   ///< its error
    vmask<float> sure;
};

inline SphereCrossing crossing(const SphereTest& test, const SphereApproach& near,
                               const RayPacket<float>& rays, const RayScale& scale)
{
    const vreal<float> b = dot(test.w, rays.dir);
    const vreal<float> reach = abs(b) * scale.inverse;
    const vreal<float> discriminant = msub(rays.dir2, test.radius2, near.moment2);
    const vreal<float> inverse_root =
        rough_inverse_sqrt(max(discriminant, vreal<float>(least_discriminant)));
    const vreal<float> half = (discriminant * inverse_root) * scale.inverse2;
    SphereCrossing result;
    result.along = along_error(test.bounds, reach) * scale.inverse;
    result.middle = negated(b) * scale.inverse2;
    result.roots.near = result.middle - half;
    result.roots.far = result.middle + half;
    const vreal<float> other_error =
        madd(vreal<float>(least_root_error), scale.inverse2, result.along);
    result.roots.error = madd(root_error(test.bounds, reach), inverse_root, other_error);
    result.sure = from_bits<float>(near.near) & (near.moment2 < test.bounds.inner2 * rays.dir2);
    return result;
}

/// Half the length of the interval that contains both roots, in lanes that may miss the sphere.
inline vreal<float> band_error(const SphereTest& test, const SphereCrossing& at,
                               const RayScale& scale)
{
    return madd(vreal<float>(2.0f * inflation) * sqrt(test.bounds.band2), scale.inverse, at.along);
}

/// Keeps the closest hits of lanes that do not certainly miss the sphere and do not start on it.
inline void keep_near_sphere(HitPacket<float>& hit, const SphereTest& test,
                             const SphereApproach& near, const RayPacket<float>& rays,
                             const RayScale& scale, std::int32_t surface)
{
    const vreal<float> middle = negated(dot(test.w, rays.dir)) * scale.inverse2;
    const std::uint32_t open =
        may_be_within(near.near, middle, test.bounds.reach, rays, scale, hit.t);
    if (open == 0)
        return;
    const SphereCrossing at = crossing(test, {near.moment2, open}, rays, scale);
    keep_first_of(hit, at.roots, at.sure, rays.t_min, surface);
    const std::uint32_t band = open & ~bits(at.sure);
    if (band == 0)
        return;
    const vreal<float> error = band_error(test, at, scale);
    const std::uint32_t behind = bits(at.middle + error < rays.t_min);
    keep_doubt(hit, from_bits<float>(band & ~behind), at.middle - error, 0);
}

/// Occlusion that is decided without a root: rays from outside that pass through the sphere between
/// t_min and t_end, or that have the sphere behind them or completely beyond t_end. The other lanes
/// of `near` are `left`.
struct PlainOcclusion {
    std::uint32_t blocked;
    std::uint32_t left;
};

inline PlainOcclusion plainly_occludes(const SphereTest& test, const SphereApproach& near,
                                       const RayPacket<float>& rays, const RayScale& scale,
                                       const vreal<float>& t_end)
{
    const vreal<float> b = dot(test.w, rays.dir);
    const vreal<float> slack =
        along_error<vreal<float>>(test.bounds, abs(b) * scale.inverse) * scale.length;
    const vreal<float> first_slope = madd(rays.dir2, rays.t_min, b);
    const vreal<float> last_slope = madd(rays.dir2, t_end, b);
    // w + t_min d|² is at least |w|² + 2 t_min b.
    const vreal<float> distance2 = madd(rays.t_min + rays.t_min, b - slack,
                                        dot(test.w, test.w) * vreal<float>(1.0f - roundoffs(8.0f)));
    const vreal<float> outer2 = test.bounds.outer2 * vreal<float>(1.0f + roundoffs(8.0f));
    const std::uint32_t outside = bits(distance2 > outer2) & near.near;
    const std::uint32_t through = bits((near.moment2 < test.bounds.inner2 * rays.dir2) &
                                       (first_slope < negated(slack)) & (last_slope > slack));
    const vreal<float> beyond = negated(last_slope) - slack;
    const std::uint32_t clear = bits(b > slack) | bits((beyond > vreal<float>(0.0f)) &
                                                       (beyond * beyond > outer2 * rays.dir2));
    return {outside & through, near.near & ~(outside & (through | clear))};
}

/// Whether the sphere occludes the lanes that do not certainly miss it, between t_min and t_end.
inline Occlusion occludes(const SphereTest& test, const SphereApproach& near,
                          const RayPacket<float>& rays, const RayScale& scale,
                          const vreal<float>& t_end)
{
    const PlainOcclusion plain = plainly_occludes(test, near, rays, scale, t_end);
    if (plain.left == 0)
        return {plain.blocked, 0};
    const SphereApproach left{near.moment2, plain.left};
    const SphereCrossing at = crossing(test, left, rays, scale);
    Occlusion result = root_between(at.roots, at.sure, rays.t_min, t_end);
    result.blocked |= plain.blocked;
    const std::uint32_t band = plain.left & ~bits(at.sure);
    if (band == 0)
        return result;
    const vreal<float> error = band_error(test, at, scale);
    const std::uint32_t outside =
        bits(at.middle + error < rays.t_min) | bits(at.middle - error > t_end);
    note_in_the_way(band & ~outside, abi::Cause::tangent);
    result.unsure |= band & ~outside;
    return result;
}

/// Tests one sphere with error bounds, for a packet of rays.
template <class Own>
inline void keep_sphere(HitPacket<float>& hit, const SphereTest& test, const SphereApproach& near,
                        const RayPacket<float>& rays, const RayScale& scale, std::int32_t surface,
                        const Own& own)
{
    const std::uint32_t others = near.near & own.template lanes_on_others<float>(surface);
    if (others != 0)
        keep_near_sphere(hit, test, {near.moment2, others}, rays, scale, surface);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
