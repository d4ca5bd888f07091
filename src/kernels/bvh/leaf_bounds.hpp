#pragma once

#include "kernels/bvh/leaf_filters.hpp"

// Error bounds of the objects of a BVH for a bundle of rays. They depend on where the rays start.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The active lanes whose magnitudes the bounds do not hold for.
inline std::uint32_t uncertifiable(const RayPacket<float>& rays, std::uint32_t active)
{
    return active & ~bits(certifiable(rays));
}

/// Calls `doubt(first, lanes)` for all active rays.
template <class Doubt>
inline void doubt_active(const RayBundle<float>& bundle, Doubt&& doubt)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if (active != 0)
            doubt(first, active);
    }
}

/// Calls `doubt(first, lanes)` for the active rays whose magnitudes the bounds do not hold for.
template <class Doubt>
inline void doubt_uncertifiable(const RayBundle<float>& bundle, Doubt&& doubt)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if (active == 0)
            continue;
        const std::uint32_t doubted = uncertifiable(load_rays(bundle, first), active);
        if (doubted != 0)
            doubt(first, doubted);
    }
}

/// Sets bundle.inverse, and returns the box of the origins of packets with active rays. Calls
/// `doubt` as doubt_uncertifiable() does.
template <class Doubt>
inline Box<float> box_of_origins(RayBundle<float>& bundle, Doubt&& doubt)
{
    // Rays that are not active are included: their values are those of a neighbour.
    PacketBox<float> origins;
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        // All packets of a cell are tested together, so all get values.
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
    return origins.box();
}

/// Sets the bundle's shared origin, if it has one, and its largest distance from a sphere's centre.
inline void set_origins(RayBundle<float>& bundle, const Box<float>& box,
                        const abi::BvhView<float>& bvh)
{
    float distance2 = 0;
    bundle.one_origin = true;
    for (int axis = 0; axis < 3; ++axis) {
        bundle.one_origin &= box.low[axis] == box.high[axis];
        bundle.origin[axis] = box.low[axis];
        const float most =
            max(max(0.0f, bvh.middle[axis] - box.low[axis]), box.high[axis] - bvh.middle[axis]);
        distance2 += most * most;
    }
    bundle.length = (__builtin_sqrtf(distance2) + bvh.radius) * inflation;
}

/// Sets the values that the error bounds of the BVH's spheres depend on: where the bundle's rays
/// start. Calls `doubt(first, lanes)` for the active rays that the bounds do not hold for.
template <class Doubt>
inline void bound_origins(RayBundle<float>& bundle, const abi::GeometryView<float>& scene,
                          Doubt&& doubt)
{
    const abi::BvhView<float>& bvh = scene.tree;
    const Box<float> box = box_of_origins(bundle, doubt);
    if (!scene.certifiable || !certifiable(origins_in(box.low, box.high)))
        doubt_active(bundle, doubt);
    set_origins(bundle, box, bvh);
    if (bvh.run_surfaces != nullptr && bundle.filters->run_surfaces != bvh.run_surfaces)
        bundle.filters->begin(bvh.run_surfaces);
    bundle.center_error = bvh.center_error;
    bundle.moment_error = first_lane<float>(
        moment_error(vreal<float>(bvh.center_error), vreal<float>(bundle.length)));
}

inline RayScale scale_of(const RayBundle<float>& bundle, int first, const RayPacket<float>& rays)
{
    return {rays, load(bundle.inverse + first)};
}

/// The error bounds of spheres in the BVH for the rays of a bundle.
inline SphereBounds<vreal<float>> leaf_bounds(const RayBundle<float>& bundle,
                                              const vreal<float>& radius)
{
    return sphere_bounds(radius, vreal<float>(bundle.center_error),
                         vreal<float>(bundle.moment_error));
}

/// An upper bound of the outer bound of sphere_bounds().
inline vreal<float> leaf_outer(const RayBundle<float>& bundle, const vreal<float>& radius)
{
    const vreal<float> moment(bundle.moment_error * (1.0f + roundoffs(12.0f)));
    return madd(radius, vreal<float>(1.0f + roundoffs(12.0f)), moment);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
