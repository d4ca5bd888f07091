#pragma once

#include "kernels/bvh/cell_rays.hpp"
#include "kernels/bvh/near_spheres.hpp"
#include "kernels/lists/callback.hpp"
#include "kernels/lists/occluded.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// What happens to occluded rays: they end, as for opaque shadows, or a callable of the caller
/// decides. It is called with the object's surface and the occluded lanes of the packet at `first`,
/// and returns the lanes that need no further occluders.
class Occluder {
public:
    Occluder() = default;
    template <class Callable>
    explicit Occluder(const Callable& callable) : call_(callable)
    {
    }
    std::uint32_t operator()(std::int32_t surface, int first, std::uint32_t blocked) const
    {
        return call_ ? call_(surface, first, blocked) : blocked;
    }

private:
    Callback<std::uint32_t(std::int32_t surface, int first, std::uint32_t lanes)> call_;
};

/// Removes lanes of a packet from the active ones.
template <class Real>
inline void finish_lanes(RayBundle<Real>& bundle, int first, std::uint32_t done)
{
    bundle.active[first / cell_rays] &= static_cast<std::uint16_t>(~(done << first % cell_rays));
}

/// Reports an occluder of a single ray of a bundle; returns whether the ray continues behind it.
template <class Real>
inline bool goes_behind(RayBundle<Real>& bundle, int ray, std::int32_t surface,
                        const Occluder& occluder)
{
    const int first = ray / lanes<Real> * lanes<Real>;
    finish_lanes(bundle, first, occluder(surface, first, 1u << (ray - first)));
    return is_active(bundle, ray);
}

/// Which lanes of a packet an object of a run occludes up to t_end.
template <abi::Features F, class Real>
inline Occlusion object_occludes(const abi::BvhView<Real>& bvh, int number,
                                 const RayBundle<Real>& bundle, const RayPacket<Real>& rays,
                                 const vreal<Real>& t_end, const OwnSurface<vint<Real>>& own,
                                 RayInterval interval)
{
    return with_object_of_run(bvh, number, [&](const auto& record, const auto& shape) {
        if constexpr (F.exact) {
            return occludes<Origin::any>(leaf_filter(number, record, shape, bundle), rays,
                                         RayScale(rays), t_end,
                                         CertainOthers{own, all_lanes<float>});
        } else {
            const Body body = body_of(record);
            return Occlusion{
                but_own<Real>(occluding_lanes(RayEnd<Real>{t_end, interval}, record, rays), own,
                              body),
                0};
        }
    });
}

template <abi::Features F, class Real>
[[gnu::noinline]] bool goes_behind_run(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle,
                                       int ray, RayInterval interval, std::uint32_t child,
                                       const Occluder& occluder)
{
    const abi::Primitive kind = primitive_of_run(bvh, abi::first_of_run(child));
    const StepScope step(step_of(kind));
    record_live(1);
    const RayPacket<Real> rays = broadcast_ray(bundle, ray);
    const OwnSurface<vint<Real>> own{vint<Real>(bundle.own[ray])};
    for (int i = 0; i < abi::run_count(child); ++i) {
        const int number = abi::first_of_run(child) + i;
        count_tests(kind, 1);
        const Occlusion occlusion = object_occludes<F>(bvh, number, bundle, rays,
                                                       vreal<Real>(bundle.t[ray]), own, interval);
        if (occlusion.unsure != 0)
            doubt_ray(bundle, ray, occlusion.unsure);
        if (occlusion.blocked != 0 && !goes_behind(bundle, ray, bvh.run_surfaces[number], occluder))
            return false;
    }
    return true;
}

/// A bit for each sphere of a leaf that occludes a ray, which `alone` holds too.
template <abi::Features F, class Real>
inline std::uint32_t blocking_spheres_of(RayBundle<Real>& bundle, int ray,
                                         const BlockRay<Real>& alone, const SphereLeaf<Real>& leaf,
                                         const abi::ShapesView& shapes, RayInterval interval)
{
    if constexpr (F.exact) {
        const std::uint32_t near = alone.near(leaf.block, bundle, ray);
        return near == 0 ? 0 : blocking_spheres(bundle, ray, leaf, shapes, near);
    } else {
        return alone.blocked_by(leaf.block, bundle.t[ray], interval);
    }
}

/// Tests a ray, which `alone` holds too, against one leaf; returns whether it continues behind it.
template <abi::Features F, class Real>
inline bool goes_behind_leaf(const abi::BvhView<Real>& bvh, RayBundle<Real>& bundle, int ray,
                             const BlockRay<Real>& alone, RayInterval interval, std::uint32_t child,
                             const Occluder& occluder)
{
    if (F.quadrics && abi::is_run(child))
        return goes_behind_run<F>(bvh, bundle, ray, interval, child, occluder);
    const StepScope step(abi::Step::spheres);
    abi::SphereBlock<Real> gathered;
    const SphereLeaf<Real> leaf = sphere_leaf(bvh, child, gathered);
    count_block_tests(leaf.block);
    std::uint32_t blocking =
        blocking_spheres_of<F>(bundle, ray, alone, leaf, *bvh.shapes, interval);
    for (; blocking != 0; blocking &= blocking - 1) {
        const std::int32_t surface = leaf.surface_of(__builtin_ctz(blocking));
        if (surface != bundle.own[ray] && !goes_behind(bundle, ray, surface, occluder))
            return false;
    }
    return true;
}

/// Finds the occluders of a ray below `child`.
template <abi::Features F, class Real>
inline void occluders_of_ray(const abi::BvhView<Real>& bvh, const SlabRays& slabs,
                             RayBundle<Real>& bundle, int ray, std::uint32_t child,
                             RayInterval interval, const Occluder& occluder)
{
    const BlockRay<Real> alone(bundle, ray);
    SlabRay slab = slab_ray(slabs, bundle, ray);
    walk_ray(bvh, child, slab, [&](std::uint32_t leaf) {
        return goes_behind_leaf<F>(bvh, bundle, ray, alone, interval, leaf, occluder);
    });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
