#pragma once

#include "kernels/bvh/leaf_bounds.hpp"

// Tests one ray against the spheres of a block side by side, by the operations that test one sphere
// against a packet of rays, so with the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Loads a packet of a block's values from `first` on.
template <class Real>
inline vreal<Real> load_of_block(const Real* block, int first)
{
    return load(block + first);
}

/// One ray of a bundle, in every lane.
template <class Real>
inline RayPacket<Real> broadcast_ray(const RayBundle<Real>& bundle, int ray)
{
    const auto all3 = [ray](const Real(&from)[3][bundle_rays]) {
        return Vec3v<Real>{vreal<Real>(from[0][ray]), vreal<Real>(from[1][ray]),
                           vreal<Real>(from[2][ray])};
    };
    RayPacket<Real> rays;
    rays.org = all3(bundle.org);
    rays.dir = all3(bundle.dir);
    rays.dir2 = dot(rays.dir, rays.dir);
    rays.t_min = vreal<Real>(bundle.t_min[ray]);
    return rays;
}

/// One ray, tested against one sphere per lane.
template <class Real>
class BlockRay {
    static_assert(abi::node_width % lanes<Real> == 0);

public:
    BlockRay(const RayBundle<Real>& bundle, int ray) : rays_(broadcast_ray(bundle, ray))
    {
    }

    /// A bit for each sphere that the ray hits up to `t_max`, and the t of each first hit.
    std::uint32_t first_roots(const abi::SphereBlock<Real>& block, Real t_max,
                              Real (&t)[abi::node_width]) const
    {
        std::uint32_t met = 0;
        for (int first = 0; first < abi::node_width; first += lanes<Real>) {
            const Quadratic<Real> quadratic = quadratics(block, first);
            const auto active = may_hit(quadratic);
            if (none(active))
                continue;
            HitPacket<Real> hit = no_hit<Real>(static_cast<Real>(__builtin_inf()));
            keep_first_root<Real>(hit, quadratic, active, rays_.t_min, 0);
            store(t + first, hit.t);
            const auto found = int_equal(hit.surface, vint<Real>(lane_int<Real>(0)));
            met |= (bits(found) & bits(hit.t <= vreal<Real>(t_max))) << first;
        }
        return met;
    }

    /// A bit for each sphere that occludes the ray up to `t_end`.
    std::uint32_t blocked_by(const abi::SphereBlock<Real>& block, Real t_end,
                             RayInterval interval) const
    {
        const RayEnd<Real> end{vreal<Real>(t_end), interval};
        std::uint32_t blocking = 0;
        for (int first = 0; first < abi::node_width; first += lanes<Real>)
            blocking |= bits(end.blocked_by(quadratics(block, first), rays_)) << first;
        return blocking;
    }

    /// A bit for each sphere that the ray, number `ray` of the bundle, does not certainly miss: by
    /// passing beside it, or because the sphere is behind the origin or beyond the ray's end.
    std::uint32_t near(const abi::SphereBlock<Real>& block, const RayBundle<Real>& bundle,
                       int ray) const
    {
        std::uint32_t near = 0;
        for (int first = 0; first < abi::node_width; first += lanes<Real>) {
            const Vec3v<Real> center{load(block.center[0] + first), load(block.center[1] + first),
                                     load(block.center[2] + first)};
            const Vec3v<Real> w = rays_.org - center;
            const vreal<Real> outer = leaf_outer(bundle, load(block.radius + first));
            const std::uint32_t beside = approach(w, signed_square<Real>(outer), rays_).near;
            near |= (beside & ~before_or_behind(w, outer, bundle, ray)) << first;
        }
        return near;
    }

private:
    /// Spheres that the ray starts outside of and moves away from, or that are completely beyond
    /// its end. b = w·d is known up to `slack`.
    std::uint32_t before_or_behind(const Vec3v<Real>& w, const vreal<Real>& outer,
                                   const RayBundle<Real>& bundle, int ray) const
    {
        const vreal<Real> length = rays_.dir2 * vreal<Real>(bundle.inverse[ray]);
        const vreal<Real> reach = outer * length;
        const vreal<Real> b = dot(w, rays_.dir);
        const vreal<Real> slack = madd(vreal<Real>(roundoffs(60.0f)), abs(b) + reach,
                                       vreal<Real>(bundle.center_error) * length);
        const auto leaves = (b > slack) & (dot(w, w) > outer * outer);
        const vreal<Real> last = madd(rays_.dir2, vreal<Real>(bundle.t[ray]), b);
        return bits(leaves) | bits(negated(last) > reach + slack);
    }

    Quadratic<Real> quadratics(const abi::SphereBlock<Real>& block, int first) const
    {
        const Vec3v<Real> center{load(block.center[0] + first), load(block.center[1] + first),
                                 load(block.center[2] + first)};
        const Vec3v<Real> o = rays_.org - center;
        const vreal<Real> radius2 = signed_square<Real>(load(block.radius + first));
        return sphere_quadratic<Real>(rays_, o, radius2, sphere_constant<Real>(o, radius2));
    }

    RayPacket<Real> rays_;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA

#if PACKTRACE_LANES == 16
#include "kernels/bvh/block_ray_avx512.hpp"
#endif
