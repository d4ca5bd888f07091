#pragma once

#include "kernels/traverse/leaf_bounds.hpp"

// One ray against the spheres of a block side by side, by the operations that test one sphere
// against a packet of rays, so with the same bits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// One ray in every lane.
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

/// The ray, a sphere a lane.
template <class Real>
class BlockRay {
    static_assert(abi::node_width % lanes<Real> == 0);

public:
    BlockRay(const RayBundle<Real>& bundle, int ray) : rays_(broadcast_ray(bundle, ray))
    {
    }

    /// A bit for each sphere that the ray meets up to `t_max`, and where it does so first.
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

    /// A bit for each sphere in the ray's way up to `t_end`, which is in it or not (RayEnd).
    std::uint32_t blocked_by(const abi::SphereBlock<Real>& block, Real t_end, bool closed) const
    {
        const RayEnd<Real> end{vreal<Real>(t_end), closed};
        std::uint32_t blocking = 0;
        for (int first = 0; first < abi::node_width; first += lanes<Real>)
            blocking |= bits(end.blocked_by(quadratics(block, first), rays_)) << first;
        return blocking;
    }

    /// A bit for each sphere that the ray does not miss for sure.
    std::uint32_t near(const abi::SphereBlock<Real>& block, const RayBundle<Real>& bundle) const
    {
        std::uint32_t near = 0;
        for (int first = 0; first < abi::node_width; first += lanes<Real>) {
            const Vec3v<Real> center{load(block.center[0] + first), load(block.center[1] + first),
                                     load(block.center[2] + first)};
            near |=
                approach(rays_.org - center, leaf_outer2(bundle, load(block.radius + first)), rays_)
                    .near
                << first;
        }
        return near;
    }

private:
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
#include "kernels/traverse/block_ray_avx512.hpp"
#endif
