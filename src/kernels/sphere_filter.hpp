#pragma once

#include "kernels/filter.hpp"
#include "kernels/sphere.hpp"

// Certain tests of spheres in single precision. For w = o - c, known to e_w, and the moment
// m = w × d the error of |m| is at most |d| h + u |m| with h = e_w + u |w|. So a ray whose |m| is
// above (r + h) |d| misses for sure, and one below (r - h) |d| crosses for sure;
// docs/numerics_derivations.md has the proof.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The bounds of a sphere for the origins of a group, of one sphere or of one a lane.
template <class Value>
struct SphereBounds {
    Value outer2;      ///< (r + h)², rounded up
    Value inner2;      ///< (r - h)², rounded down; negative for none
    Value t_error;     ///< of t, times |d|, but for what a small discriminant adds
    Value root_error;  ///< that is this over the root of the discriminant
    Value band2;  ///< the square of a quarter of the way in the sphere, times d·d, of a ray in
                  ///< between, at most
};

/// `center_error` is how far w may be off by but for the rounding of a subtraction, `length` the
/// largest |w|.
inline SphereBounds<vreal<float>> sphere_bounds(const vreal<float>& radius,
                                                const vreal<float>& center_error,
                                                const vreal<float>& length)
{
    const vreal<float> shift = madd(vreal<float>(roundoffs(1.2f)), length, center_error);
    const vreal<float> moment = madd(vreal<float>(roundoffs(1.2f)), length, shift);
    const vreal<float> size = radius * vreal<float>(1.0f + roundoffs(2.0f));
    const vreal<float> outer = size + moment;
    const vreal<float> inner = radius * vreal<float>(1.0f - roundoffs(2.0f)) - moment;
    const vreal<float> along = madd(vreal<float>(roundoffs(4.0f)), length, shift);
    const vreal<float> discriminant = madd(vreal<float>(roundoffs(9.0f)), size, moment);
    SphereBounds<vreal<float>> bounds;
    bounds.outer2 = signed_square<float>(outer) * vreal<float>(1.0f + roundoffs(16.0f));
    bounds.inner2 = signed_square<float>(inner) * vreal<float>(1.0f - roundoffs(16.0f));
    bounds.t_error = madd(vreal<float>(roundoffs(2.0f)), size, along);
    bounds.root_error = vreal<float>(2.0f * inflation) * size * discriminant;
    const vreal<float> widest = size * vreal<float>(1.0f + roundoffs(6.0f));
    bounds.band2 = max(size * (widest - min(inner, size)), vreal<float>(0.0f));
    return bounds;
}

/// What certain tests of a packet of rays and a sphere, or of a ray and a packet of spheres, need.
struct SphereTest {
    Vec3v<float> w;  ///< origin relative to the centre
    vreal<float> radius2;
    SphereBounds<vreal<float>> bounds;
};

/// Lanes that don't surely miss, and |m|².
struct SphereApproach {
    vreal<float> moment2;
    vmask<float> near;
};

inline SphereApproach approach(const Vec3v<float>& w, const vreal<float>& outer2,
                               const RayPacket<float>& rays)
{
    const Vec3v<float> moment = cross(w, rays.dir);
    const vreal<float> moment2 = dot(moment, moment);
    const std::uint32_t misses = bits(moment2 > outer2 * rays.dir2);
    return {moment2, from_bits<float>(~misses & all_lanes<float>)};
}

/// Both roots in the lanes that cross the sphere for sure.
struct SphereCrossing {
    RootIntervals roots;
    vreal<float> middle;  ///< t of the nearest approach
    vmask<float> sure;
};

inline SphereCrossing crossing(const SphereTest& test, const SphereApproach& near,
                               const RayPacket<float>& rays, const RayScale& scale)
{
    const vreal<float> b = dot(test.w, rays.dir);
    const vreal<float> discriminant = msub(rays.dir2, test.radius2, near.moment2);
    const vreal<float> root = sqrt(max(discriminant, vreal<float>(0.0f)));
    const vreal<float> error =
        madd(test.bounds.t_error, scale.inverse, test.bounds.root_error / root);
    const vreal<float> per_t(roundoffs(12.0f));
    SphereCrossing result;
    result.middle = negated(b) * scale.inverse2;
    result.roots.near = (negated(b) - root) * scale.inverse2;
    result.roots.far = (root - b) * scale.inverse2;
    result.roots.near_error = madd(per_t, abs(result.roots.near), error);
    result.roots.far_error = madd(per_t, abs(result.roots.far), error);
    result.sure = near.near & (near.moment2 < test.bounds.inner2 * rays.dir2);
    return result;
}

/// Half the interval that holds both roots in lanes that may or may not cross the sphere.
inline vreal<float> band_error(const SphereTest& test, const SphereCrossing& at,
                               const RayScale& scale)
{
    const vreal<float> half =
        madd(vreal<float>(2.0f * inflation), sqrt(test.bounds.band2), test.bounds.t_error);
    return madd(half, scale.inverse, vreal<float>(roundoffs(12.0f)) * abs(at.middle));
}

/// The closest hit of a packet that is near the sphere, but for the lanes that start on it.
inline void keep_near_sphere(HitPacket<float>& hit, const SphereTest& test,
                             const SphereApproach& near, const RayPacket<float>& rays,
                             const RayScale& scale, std::int32_t surface)
{
    const SphereCrossing at = crossing(test, near, rays, scale);
    keep_first_of(hit, at.roots, at.sure, rays.t_min, surface);
    const std::uint32_t band = bits(near.near) & ~bits(at.sure);
    if (band == 0)
        return;
    const vreal<float> error = band_error(test, at, scale);
    const std::uint32_t behind = bits(at.middle + error < rays.t_min);
    keep_doubt(hit, from_bits<float>(band & ~behind), at.middle - error);
}

/// Whether the sphere is between t_min and t_end of the lanes that are near it.
inline Occlusion occludes(const SphereTest& test, const SphereApproach& near,
                          const RayPacket<float>& rays, const RayScale& scale,
                          const vreal<float>& t_end)
{
    const SphereCrossing at = crossing(test, near, rays, scale);
    Occlusion result = root_between(at.roots, at.sure, rays.t_min, t_end);
    const std::uint32_t band = bits(near.near) & ~bits(at.sure);
    if (band == 0)
        return result;
    const vreal<float> error = band_error(test, at, scale);
    const std::uint32_t outside =
        bits(at.middle + error < rays.t_min) | bits(at.middle - error > t_end);
    result.unsure |= band & ~outside;
    return result;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
