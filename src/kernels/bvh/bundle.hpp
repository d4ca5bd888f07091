#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/precision/lone_sphere.hpp"
#include "kernels/precision/own_surface.hpp"
#include "kernels/stats/observe.hpp"

// Rays that traverse the BVH together: those of a tile, or as many of a stream.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline constexpr int bundle_rays = abi::tile_pixels;
/// A bundle is divided into cells of 16 rays. Along a tile's Z-order curve a cell has 4 x 4 pixels.
inline constexpr int cell_rays = 16;
inline constexpr int bundle_cells = bundle_rays / cell_rays;

struct LeafFilters;

/// Rays that are not active have a `t` of minus infinity; their other values are those of a
/// neighbour.
template <class Real>
struct alignas(64) RayBundle {
    Real org[3][bundle_rays];
    Real dir[3][bundle_rays];
    Real t_min[bundle_rays];
    Real t[bundle_rays];  ///< end of the ray: its closest hit so far, or the light
    lane_int<Real> surface[bundle_rays];
    lane_int<Real> own[bundle_rays];     ///< surface that the ray starts on; -1: none
    std::uint16_t active[bundle_cells];  ///< one bit per ray
    // With Features::exact only: as in HitPacket, and the rays that may be occluded.
    Real t_low[bundle_rays];
    Real other[bundle_rays];
    std::uint16_t unsure[bundle_cells];
    // With Features::exact only: error bounds of objects in the BVH.
    Real inverse[bundle_rays];  ///< 1 / |d|
    bool one_origin;            ///< all active rays start at `origin`, except for NaN
    float origin[3];
    float length;  ///< largest distance between any ray origin and any sphere's centre in the BVH
    float center_error;    ///< upper bound of the rounding error of any sphere's centre in the BVH
    float moment_error;    ///< moment_error() for all these spheres (sphere_filter.hpp)
    LeafFilters* filters;  ///< kept for the next bundles of the same call (leaf_filters.hpp)
};

/// Makes lanes of the packet at `first` unsure.
template <class Real>
inline void doubt_lanes(RayBundle<Real>& bundle, int first, std::uint32_t unsure)
{
    keep_noted(first, unsure);
    bundle.unsure[first / cell_rays] |= static_cast<std::uint16_t>(unsure << first % cell_rays);
}

/// Makes a single ray unsure, for a cause that was recorded for `lanes_of`; every lane holds this
/// ray.
template <class Real>
inline void doubt_ray(RayBundle<Real>& bundle, int ray, std::uint32_t lanes_of)
{
    keep_noted_of_ray(ray, lanes_of);
    bundle.unsure[ray / cell_rays] |= static_cast<std::uint16_t>(1u << ray % cell_rays);
}

/// The unsure lanes of the packet at `first`.
template <class Real>
inline std::uint32_t unsure_of(const RayBundle<Real>& bundle, int first)
{
    return bundle.unsure[first / cell_rays] >> first % cell_rays & all_lanes<Real>;
}

template <class Real>
inline RayPacket<Real> load_rays(const RayBundle<Real>& bundle, int first)
{
    const auto load3 = [first](const Real(&from)[3][bundle_rays]) {
        return Vec3v<Real>{load(from[0] + first), load(from[1] + first), load(from[2] + first)};
    };
    RayPacket<Real> rays;
    rays.org = load3(bundle.org);
    rays.dir = load3(bundle.dir);
    rays.dir2 = dot(rays.dir, rays.dir);
    rays.t_min = load(bundle.t_min + first);
    return rays;
}

template <class Real>
inline void store_rays(RayBundle<Real>& bundle, int first, const RayPacket<Real>& rays)
{
    const auto store3 = [first](Real(&to)[3][bundle_rays], const Vec3v<Real>& v) {
        store(to[0] + first, v.x);
        store(to[1] + first, v.y);
        store(to[2] + first, v.z);
    };
    store3(bundle.org, rays.org);
    store3(bundle.dir, rays.dir);
    store(bundle.t_min + first, rays.t_min);
}

template <class Real>
inline HitPacket<Real> load_hits(const RayBundle<Real>& bundle, int first)
{
    load_rivals<Real>(first);
    return {load(bundle.t + first), load(bundle.surface + first), load(bundle.t_low + first),
            load(bundle.other + first)};
}

template <abi::Features F, class Real>
inline void store_hits(RayBundle<Real>& bundle, int first, const HitPacket<Real>& hit)
{
    store(bundle.t + first, hit.t);
    store(bundle.surface + first, hit.surface);
    if constexpr (F.exact) {
        store_rivals<Real>(first);
        store(bundle.t_low + first, hit.t_low);
        store(bundle.other + first, hit.other);
    }
}

template <class Real>
inline OwnSurface<vint<Real>> own_of(const RayBundle<Real>& bundle, int first)
{
    return {load(bundle.own + first)};
}

/// The active lanes of the packet at `first`.
template <class Real>
inline std::uint32_t active_lanes(const RayBundle<Real>& bundle, int first)
{
    return bundle.active[first / cell_rays] >> first % cell_rays & all_lanes<Real>;
}

/// The surfaces that a packet starts on, for tests against all objects of a list; any lane is
/// `active`.
template <class Real>
inline OwnSurface<vint<Real>> common_own_of(const RayBundle<Real>& bundle, int first,
                                            std::uint32_t active)
{
    const vint<Real> own = load(bundle.own + first);
    return own_with_common<Real>(own, bundle.own[first + __builtin_ctz(active)], active);
}

/// One ray of a bundle, in double.
inline WideRay wide_ray(const RayBundle<float>& bundle, int ray)
{
    const float(&org)[3][bundle_rays] = bundle.org;
    const float(&dir)[3][bundle_rays] = bundle.dir;
    return {{org[0][ray], org[1][ray], org[2][ray]},
            {dir[0][ray], dir[1][ray], dir[2][ray]},
            bundle.t_min[ray]};
}

template <class Real>
inline bool is_active(const RayBundle<Real>& bundle, int ray)
{
    return (bundle.active[ray / cell_rays] >> ray % cell_rays & 1) != 0;
}

/// Calls `visit(ray)` for the active rays of `cells`.
template <class Real, class Visit>
inline void for_each_active(const RayBundle<Real>& bundle, std::uint32_t cells, const Visit& visit)
{
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        for (std::uint32_t left = bundle.active[cell]; left != 0; left &= left - 1)
            visit(cell * cell_rays + __builtin_ctz(left));
    }
}

/// Sets the packet at `first` to its hits so far and to the surfaces that it starts on. Rays not in
/// `active` end before they start.
template <abi::Features F, class Real>
inline void start_rays(RayBundle<Real>& bundle, int first, const HitPacket<Real>& hit,
                       const vint<Real>& own, std::uint32_t active)
{
    const vreal<Real> never(static_cast<Real>(-__builtin_inf()));
    HitPacket<Real> start = hit;
    start.t = select(from_bits<Real>(active), hit.t, never);
    store_hits<F>(bundle, first, start);
    store(bundle.own + first, own);
    std::uint16_t& cell = bundle.active[first / cell_rays];
    const std::uint32_t others = ~(all_lanes<Real> << first % cell_rays);
    cell = static_cast<std::uint16_t>((cell & others) | active << first % cell_rays);
    if (first % cell_rays == 0)
        bundle.unsure[first / cell_rays] = 0;
}

/// Sets the packet at `first` to rays whose occluders are searched for up to `t_end`; otherwise as
/// start_rays().
template <abi::Features F, class Real>
inline void start_segments(RayBundle<Real>& bundle, int first, const RayPacket<Real>& rays,
                           const vreal<Real>& t_end, const vint<Real>& own, std::uint32_t active)
{
    store_rays(bundle, first, rays);
    start_rays<F>(bundle, first, no_hit<Real>(t_end), own, active);
}

/// Copies ray `count` - 1 to the rays from `count` to the end of its cell, and marks these and all
/// later rays as not active. `count` > 0.
template <class Real>
inline void end_bundle(RayBundle<Real>& bundle, int count)
{
    for (int ray = count; ray % cell_rays != 0; ++ray) {
        for (int axis = 0; axis < 3; ++axis) {
            bundle.org[axis][ray] = bundle.org[axis][count - 1];
            bundle.dir[axis][ray] = bundle.dir[axis][count - 1];
        }
        bundle.t_min[ray] = bundle.t_min[count - 1];
        bundle.t[ray] = static_cast<Real>(-__builtin_inf());
        bundle.surface[ray] = -1;
        bundle.own[ray] = -1;
        bundle.t_low[ray] = bundle.other[ray] = static_cast<Real>(__builtin_inf());
        bundle.active[ray / cell_rays] &= static_cast<std::uint16_t>(~(1u << ray % cell_rays));
    }
    for (int cell = (count + cell_rays - 1) / cell_rays; cell < bundle_cells; ++cell)
        bundle.active[cell] = 0;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
