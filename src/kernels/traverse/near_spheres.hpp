#pragma once

#include "kernels/traverse/block_ray.hpp"
#include "kernels/traverse/lone_sphere.hpp"

// One ray against those spheres of a block that it does not miss for sure.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline float dot3(const float (&a)[3], const float (&b)[3])
{
    return madd(a[0], b[0], madd(a[1], b[1], a[2] * b[2]));
}

/// One ray of a bundle: few of a leaf's spheres are near, so that lanes would be idle.
struct LoneRay {
    float org[3];
    float dir[3];
    float dir2;
    float inverse;
    float t_min;

    LoneRay(const RayBundle<float>& bundle, int ray)
        : inverse(bundle.inverse[ray]), t_min(bundle.t_min[ray])
    {
        for (int axis = 0; axis < 3; ++axis) {
            org[axis] = bundle.org[axis][ray];
            dir[axis] = bundle.dir[axis][ray];
        }
        dir2 = dot3(dir, dir);
    }
};

/// What crossing() says of packets, of one ray and one sphere.
struct LoneCrossing {
    float near, far;
    float error;  ///< of either root, or half the interval around both where not sure
    bool sure;
};

inline LoneCrossing crossing(const RayBundle<float>& bundle, const LoneRay& ray,
                             const abi::SphereBlock<float>& block, int slot)
{
    const float w[3] = {ray.org[0] - block.center[0][slot], ray.org[1] - block.center[1][slot],
                        ray.org[2] - block.center[2][slot]};
    const auto minor = [&](int i, int j) { return madd(w[i], ray.dir[j], -(w[j] * ray.dir[i])); };
    const float moment[3] = {minor(1, 2), minor(2, 0), minor(0, 1)};
    const float moment2 = dot3(moment, moment);
    const float radius = block.radius[slot];
    const SphereBounds<float> bounds =
        sphere_bounds(radius, bundle.center_error, bundle.moment_error);
    const float b = dot3(w, ray.dir);
    const float reach = magnitude(b) * ray.inverse;
    const float inverse2 = ray.inverse * ray.inverse;
    const float middle = -b * inverse2;
    const float along = along_error(bounds, reach) * ray.inverse;
    if (!(moment2 < bounds.inner2 * ray.dir2)) {
        const float quarter = __builtin_sqrtf(bounds.band2);
        return {middle, middle, madd(2.0f * inflation * quarter, ray.inverse, along), false};
    }
    const float discriminant = madd(ray.dir2, radius * radius, -moment2);
    const float root = __builtin_sqrtf(discriminant);
    const float half = root * inverse2;
    return {middle - half, middle + half, root_error(bounds, reach) / root + along, true};
}

/// As keep_sure() and keep_doubt() do with a packet of rays.
inline void keep_sure(RayBundle<float>& bundle, int ray, float low, float high,
                      std::int32_t surface)
{
    const bool first = high < bundle.t[ray];
    const float behind = first ? bundle.t_low[ray] : low;
    if (behind < bundle.other[ray]) {
        bundle.other[ray] = behind;
        note_rival_of_ray(ray, first ? bundle.surface[ray] : surface);
    }
    if (first) {
        bundle.t[ray] = high;
        bundle.t_low[ray] = low;
        bundle.surface[ray] = surface;
    }
}
inline void keep_doubt(RayBundle<float>& bundle, int ray, float low, std::int32_t rival)
{
    if (low >= bundle.other[ray])
        return;
    bundle.other[ray] = low == low ? low : -__builtin_inff();
    note_rival_of_ray(ray, rival);
}

/// Keeps the hits of a ray on the spheres of `near`.
[[gnu::noinline]] inline void keep_near_spheres(RayBundle<float>& bundle, int ray,
                                                const SphereLeaf<float>& leaf, std::uint32_t near)
{
    const LoneRay lone(bundle, ray);
    for (; near != 0; near &= near - 1) {
        const int slot = __builtin_ctz(near);
        const std::int32_t surface = leaf.surface_of(slot);
        if (surface == bundle.own[ray])
            continue;
        const LoneCrossing at = crossing(bundle, lone, leaf.block, slot);
        if (at.far + at.error < lone.t_min)
            continue;
        const bool near_behind = at.near + at.error < lone.t_min;
        const float root = near_behind ? at.far : at.near;
        const float low = root - at.error;
        if (at.sure && low > lone.t_min)
            keep_sure(bundle, ray, low, root + at.error, surface);
        else
            keep_doubt(bundle, ray, low, rival_in_doubt(at.sure));
    }
}

/// A bit for each sphere of `near` that is in the way of a ray up to its end for sure; rays that
/// others may be in the way of are marked.
[[gnu::noinline]] inline std::uint32_t blocking_spheres(RayBundle<float>& bundle, int ray,
                                                        const SphereLeaf<float>& leaf,
                                                        const abi::ShapesView& shapes,
                                                        std::uint32_t near)
{
    const LoneRay lone(bundle, ray);
    const float end = bundle.t[ray];
    std::uint32_t blocking = 0;
    for (; near != 0; near &= near - 1) {
        const int slot = __builtin_ctz(near);
        if (leaf.surface_of(slot) == bundle.own[ray])
            continue;
        const LoneCrossing at = crossing(bundle, lone, leaf.block, slot);
        const auto outside = [&](float root) {
            return root + at.error < lone.t_min || root - at.error > end;
        };
        const auto inside = [&](float root) {
            return root - at.error > lone.t_min && root + at.error < end;
        };
        if (at.sure && (inside(at.near) || inside(at.far))) {
            blocking |= 1u << slot;
            continue;
        }
        if (outside(at.near) && outside(at.far))
            continue;
        const InTheWay in_double = is_in_the_way(shapes, leaf.surface_of(slot), bundle, ray);
        if (in_double == InTheWay::yes) {
            blocking |= 1u << slot;
        } else if (in_double == InTheWay::undecided) {
            note_in_the_way(1u, at.sure ? abi::Cause::range : abi::Cause::tangent);
            doubt_ray(bundle, ray, 1u);
        }
    }
    return blocking;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
