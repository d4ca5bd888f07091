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

/// The bounds of a block's spheres for a bundle's rays, side by side, from when one is first asked
/// for.
class BlockBounds {
public:
    BlockBounds(const RayBundle<float>& bundle, const abi::SphereBlock<float>& block)
        : bundle_(bundle), block_(block)
    {
    }

    /// The sphere in one place of the block, for the rays of a packet of the bundle.
    SphereTest test(int slot, const RayPacket<float>& rays)
    {
        if (!is_set_)
            set();
        const auto all = [slot](const float* values) { return vreal<float>(values[slot]); };
        const Vec3v<float> center{all(block_.center[0]), all(block_.center[1]),
                                  all(block_.center[2])};
        return {rays.org - center,
                all(radius2_),
                {all(bounds_.outer2), all(bounds_.inner2), all(bounds_.along), all(bounds_.moment),
                 all(bounds_.size), all(bounds_.band2)}};
    }

private:
    void set()
    {
        for (int first = 0; first < abi::node_width; first += lanes<float>) {
            const vreal<float> radius = load_of_block(block_.radius, first);
            const SphereBounds<vreal<float>> bounds = leaf_bounds(bundle_, radius);
            store(radius2_ + first, radius * radius);
            store(bounds_.outer2 + first, bounds.outer2);
            store(bounds_.inner2 + first, bounds.inner2);
            store(bounds_.along + first, bounds.along);
            store(bounds_.moment + first, bounds.moment);
            store(bounds_.size + first, bounds.size);
            store(bounds_.band2 + first, bounds.band2);
        }
        is_set_ = true;
    }

    /// A block, or a packet where that is more.
    static constexpr int room = lanes<float> > abi::node_width ? lanes<float> : abi::node_width;
    using Values = float[room];

    const RayBundle<float>& bundle_;
    const abi::SphereBlock<float>& block_;
    bool is_set_ = false;
    alignas(64) Values radius2_;
    alignas(64) SphereBounds<Values> bounds_;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
