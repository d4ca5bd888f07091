#pragma once

#include "kernels/geometry/kinds.hpp"
#include "kernels/traverse/leaf.hpp"

// Error bounds of the objects of a hierarchy for a bundle of rays, by where those start.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Sets what a bundle's bounds of the hierarchy's spheres hang on: where its rays start.
inline void bound_origins(RayBundle<float>& bundle, const abi::BvhView<float>& tree)
{
    float distance2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        vreal<float> low(__builtin_inff());
        vreal<float> high(-__builtin_inff());
        for (int first = 0; first < bundle_rays; first += lanes<float>) {
            if (active_lanes(bundle, first) == 0)
                continue;
            const vmask<float> active = from_bits<float>(active_lanes(bundle, first));
            const vreal<float> org = load(bundle.org[axis] + first);
            low = select(active, min(low, org), low);
            high = select(active, max(high, org), high);
        }
        float lowest;
        float highest;
        extent_of_lanes(low, high, lowest, highest);
        const float most = max(max(0.0f, tree.middle[axis] - lowest), highest - tree.middle[axis]);
        distance2 += most * most;
    }
    for (int first = 0; first < bundle_rays; first += lanes<float>)
        if (active_lanes(bundle, first) != 0)
            store(bundle.inverse + first, RayScale(load_rays(bundle, first)).inverse);
    bundle.length = (__builtin_sqrtf(distance2) + tree.radius) * inflation;
    bundle.center_error = tree.center_error;
    bundle.moment_error = first_lane<float>(
        moment_error(vreal<float>(tree.center_error), vreal<float>(bundle.length)));
}

inline RayScale scale_of(const RayBundle<float>& bundle, int first, const RayPacket<float>& rays)
{
    return {rays, load(bundle.inverse + first)};
}

/// The bounds of an object of a run for a bundle's rays.
template <template <class> class Record>
inline auto leaf_filter(const Record<float>& record, const Record<double>& wide,
                        const RayBundle<float>& bundle)
{
    Origins origins;
    for (int axis = 0; axis < 3; ++axis)
        origins.center[axis] = record.bound[axis];
    origins.radius = bundle.length;
    return certain_form<false>(record, wide, origins);
}

/// The bounds of spheres of a hierarchy for a bundle's rays.
inline SphereBounds<vreal<float>> leaf_bounds(const RayBundle<float>& bundle,
                                              const vreal<float>& radius)
{
    return sphere_bounds(radius, vreal<float>(bundle.center_error),
                         vreal<float>(bundle.moment_error));
}

/// The outer bound alone, above the one of sphere_bounds(); leaf_outer2() is its square.
inline vreal<float> leaf_outer(const RayBundle<float>& bundle, const vreal<float>& radius)
{
    const vreal<float> moment(bundle.moment_error * (1.0f + roundoffs(12.0f)));
    return madd(radius, vreal<float>(1.0f + roundoffs(12.0f)), moment);
}
inline vreal<float> leaf_outer2(const RayBundle<float>& bundle, const vreal<float>& radius)
{
    return signed_square<float>(leaf_outer(bundle, radius));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
