#pragma once

#include "kernels/geometry/kinds.hpp"
#include "kernels/traverse/leaf.hpp"

// Error bounds of the objects of a hierarchy for a bundle of rays, by where those start.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Sets what a bundle's bounds of the hierarchy's spheres hang on: where its rays start.
inline void bound_origins(RayBundle<float>& bundle, const abi::BvhView<float>& tree)
{
    // Of rays that are not active, too: they are like their neighbours.
    PacketBox<float> origins;
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        if (active_lanes(bundle, first) == 0)
            continue;
        const RayPacket<float> rays = load_rays(bundle, first);
        origins.add(rays.org);
        store(bundle.inverse + first, RayScale(rays).inverse);
    }
    const Box<float> box = origins.box();
    float distance2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float most =
            max(max(0.0f, tree.middle[axis] - box.low[axis]), box.high[axis] - tree.middle[axis]);
        distance2 += most * most;
    }
    bundle.length = (__builtin_sqrtf(distance2) + tree.radius) * inflation;
    bundle.center_error = tree.center_error;
    bundle.moment_error = first_lane<float>(
        moment_error(vreal<float>(tree.center_error), vreal<float>(bundle.length)));
}

/// Calls `visit(first, lanes)` for the active rays whose magnitudes no bounds hold for: for all of
/// them where the origins' are not certifiable.
template <class Visit>
inline void for_each_uncertifiable(const RayBundle<float>& bundle, bool certifiable_origins,
                                   const Visit& visit)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if (active == 0)
            continue;
        const std::uint32_t certain =
            certifiable_origins ? bits(certifiable(load_rays(bundle, first))) : 0;
        if ((active & ~certain) != 0)
            visit(first, active & ~certain);
    }
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

/// The outer bound alone, above the one of sphere_bounds().
inline vreal<float> leaf_outer(const RayBundle<float>& bundle, const vreal<float>& radius)
{
    const vreal<float> moment(bundle.moment_error * (1.0f + roundoffs(12.0f)));
    return madd(radius, vreal<float>(1.0f + roundoffs(12.0f)), moment);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
