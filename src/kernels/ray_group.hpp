#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/observe.hpp"
#include "kernels/own_surface.hpp"

// Rays that go through the hierarchy together: a tile's, or as many of a stream.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline constexpr int group_rays = abi::tile_pixels;
/// A group's rays are looked at in cells: along a tile's curve these are 4 x 4 pixels.
inline constexpr int cell_rays = 16;
inline constexpr int group_cells = group_rays / cell_rays;

/// Rays that are not active have a `t` of minus infinity, and are like their neighbours.
template <class Real>
struct alignas(64) RayGroup {
    Real org[3][group_rays];
    Real dir[3][group_rays];
    Real t_min[group_rays];
    Real t[group_rays];  ///< where the ray ends: at its closest hit so far, or the light
    lane_int<Real> surface[group_rays];
    lane_int<Real> own[group_rays];     ///< the surface the ray starts on; -1: none
    std::uint16_t active[group_cells];  ///< a bit a ray
    // With Features::exact, as HitPacket has them; and rays that something may be in the way of.
    Real t_low[group_rays];
    Real other[group_rays];
    std::uint16_t unsure[group_cells];
    // With Features::exact, for the objects of the hierarchy.
    Real inverse[group_rays];  ///< 1 / |d|
    float length;        ///< the largest distance of an origin from any centre of a sphere there
    float center_error;  ///< of the spheres there
    float moment_error;  ///< likewise, by sphere_filter.hpp
};

/// Lanes of the packet at `first` become unsure.
template <class Real>
inline void doubt_lanes(RayGroup<Real>& group, int first, std::uint32_t unsure)
{
    keep_noted(first, unsure);
    group.unsure[first / cell_rays] |= static_cast<std::uint16_t>(unsure << first % cell_rays);
}

/// The unsure lanes of the packet at `first`.
template <class Real>
inline std::uint32_t unsure_of(const RayGroup<Real>& group, int first)
{
    return group.unsure[first / cell_rays] >> first % cell_rays & all_lanes<Real>;
}

template <class Real>
inline RayPacket<Real> load_rays(const RayGroup<Real>& group, int first)
{
    const auto load3 = [first](const Real(&from)[3][group_rays]) {
        return Vec3v<Real>{load(from[0] + first), load(from[1] + first), load(from[2] + first)};
    };
    RayPacket<Real> rays;
    rays.org = load3(group.org);
    rays.dir = load3(group.dir);
    rays.dir2 = dot(rays.dir, rays.dir);
    rays.t_min = load(group.t_min + first);
    return rays;
}

template <class Real>
inline void store_rays(RayGroup<Real>& group, int first, const RayPacket<Real>& rays)
{
    const auto store3 = [first](Real(&to)[3][group_rays], const Vec3v<Real>& v) {
        store(to[0] + first, v.x);
        store(to[1] + first, v.y);
        store(to[2] + first, v.z);
    };
    store3(group.org, rays.org);
    store3(group.dir, rays.dir);
    store(group.t_min + first, rays.t_min);
}

template <class Real>
inline HitPacket<Real> load_hits(const RayGroup<Real>& group, int first)
{
    load_rivals<Real>(first);
    return {load(group.t + first), load(group.surface + first), load(group.t_low + first),
            load(group.other + first)};
}

template <abi::Features F, class Real>
inline void store_hits(RayGroup<Real>& group, int first, const HitPacket<Real>& hit)
{
    store(group.t + first, hit.t);
    store(group.surface + first, hit.surface);
    if constexpr (F.exact) {
        store_rivals<Real>(first);
        store(group.t_low + first, hit.t_low);
        store(group.other + first, hit.other);
    }
}

template <class Real>
inline OwnSurface<vint<Real>> own_of(const RayGroup<Real>& group, int first)
{
    return {load(group.own + first)};
}

/// The lanes of the packet at `first` that are wanted.
template <class Real>
inline std::uint32_t active_lanes(const RayGroup<Real>& group, int first)
{
    return group.active[first / cell_rays] >> first % cell_rays & all_lanes<Real>;
}

template <class Real>
inline bool is_active(const RayGroup<Real>& group, int ray)
{
    return (group.active[ray / cell_rays] >> ray % cell_rays & 1) != 0;
}

/// Calls `visit(ray)` for the active rays of `cells`.
template <class Real, class Visit>
inline void for_each_active(const RayGroup<Real>& group, std::uint32_t cells, const Visit& visit)
{
    for (; cells != 0; cells &= cells - 1) {
        const int cell = __builtin_ctz(cells);
        for (std::uint32_t left = group.active[cell]; left != 0; left &= left - 1)
            visit(cell * cell_rays + __builtin_ctz(left));
    }
}

/// The rays of the packet at `first` have hit `hit` so far, their search passes over `own`, and
/// those not in `active` end before they start.
template <abi::Features F, class Real>
inline void start_rays(RayGroup<Real>& group, int first, const HitPacket<Real>& hit,
                       const vint<Real>& own, std::uint32_t active)
{
    const vreal<Real> never(static_cast<Real>(-__builtin_inf()));
    HitPacket<Real> start = hit;
    start.t = select(from_bits<Real>(active), hit.t, never);
    store_hits<F>(group, first, start);
    store(group.own + first, own);
    std::uint16_t& cell = group.active[first / cell_rays];
    const std::uint32_t others = ~(all_lanes<Real> << first % cell_rays);
    cell = static_cast<std::uint16_t>((cell & others) | active << first % cell_rays);
    if (first % cell_rays == 0)
        group.unsure[first / cell_rays] = 0;
}

/// Makes the rays from `count` to the end of its cell like the one before it, and marks them and
/// all later ones as not active. `count` > 0.
template <class Real>
inline void end_group(RayGroup<Real>& group, int count)
{
    for (int ray = count; ray % cell_rays != 0; ++ray) {
        for (int axis = 0; axis < 3; ++axis) {
            group.org[axis][ray] = group.org[axis][count - 1];
            group.dir[axis][ray] = group.dir[axis][count - 1];
        }
        group.t_min[ray] = group.t_min[count - 1];
        group.t[ray] = static_cast<Real>(-__builtin_inf());
        group.surface[ray] = -1;
        group.own[ray] = -1;
        group.t_low[ray] = group.other[ray] = static_cast<Real>(__builtin_inf());
        group.active[ray / cell_rays] &= static_cast<std::uint16_t>(~(1u << ray % cell_rays));
    }
    for (int cell = (count + cell_rays - 1) / cell_rays; cell < group_cells; ++cell)
        group.active[cell] = 0;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
