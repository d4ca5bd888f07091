#pragma once

#include "kernels/bvh/leaf_filters.hpp"

// Error bounds of the objects of a hierarchy for a bundle of rays, by where those start.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Those of some lanes whose magnitudes no bounds hold for.
inline std::uint32_t uncertifiable(const RayPacket<float>& rays, std::uint32_t active)
{
    return active & ~bits(certifiable(rays));
}

/// Calls `doubt(first, lanes)` for the active rays whose magnitudes no bounds hold for: for all of
/// them where the origins' are not certifiable.
template <class Doubt>
inline void doubt_uncertifiable(const RayBundle<float>& bundle, bool certifiable_origins,
                                Doubt&& doubt)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if (active == 0)
            continue;
        const std::uint32_t doubted =
            certifiable_origins ? uncertifiable(load_rays(bundle, first), active) : active;
        if (doubted != 0)
            doubt(first, doubted);
    }
}

/// Sets what a bundle's bounds of the hierarchy's spheres hang on: where its rays start. Doubts as
/// doubt_uncertifiable() does.
template <class Doubt>
inline void bound_origins(RayBundle<float>& bundle, const abi::GeometryView<float>& scene,
                          Doubt&& doubt)
{
    const abi::BvhView<float>& tree = scene.tree;
    // Of rays that are not active, too: they are like their neighbours.
    PacketBox<float> origins;
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        // Packets of a cell are looked at together.
        if (bundle.active[first / cell_rays] == 0)
            continue;
        const std::uint32_t active = active_lanes(bundle, first);
        const RayPacket<float> rays = load_rays(bundle, first);
        store(bundle.inverse + first, RayScale(rays).inverse);
        if (active == 0)
            continue;
        origins.add(rays.org);
        const std::uint32_t doubted = uncertifiable(rays, active);
        if (doubted != 0)
            doubt(first, doubted);
    }
    const Box<float> box = origins.box();
    if (!scene.certifiable || !certifiable(origins_in(box.low, box.high)))
        doubt_uncertifiable(bundle, false, doubt);
    float distance2 = 0;
    bundle.one_origin = true;
    for (int axis = 0; axis < 3; ++axis) {
        bundle.one_origin &= box.low[axis] == box.high[axis];
        bundle.origin[axis] = box.low[axis];
        const float most =
            max(max(0.0f, tree.middle[axis] - box.low[axis]), box.high[axis] - tree.middle[axis]);
        distance2 += most * most;
    }
    bundle.length = (__builtin_sqrtf(distance2) + tree.radius) * inflation;
    if (tree.run_surfaces != nullptr && bundle.filters->run_surfaces != tree.run_surfaces)
        bundle.filters->begin(tree.run_surfaces);
    bundle.center_error = tree.center_error;
    bundle.moment_error = first_lane<float>(
        moment_error(vreal<float>(tree.center_error), vreal<float>(bundle.length)));
}

inline RayScale scale_of(const RayBundle<float>& bundle, int first, const RayPacket<float>& rays)
{
    return {rays, load(bundle.inverse + first)};
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
