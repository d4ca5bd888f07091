#pragma once

#include "kernel_abi/light_buffer.hpp"
#include "kernels/bvh/occluded_ray.hpp"
#include "kernels/simd/float_bits.hpp"

// Occlusion of a bundle of rays from one point light or towards one directional light, by the light
// buffer instead of the BVH.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The grid cells of the rays of a packet.
struct LightCells {
    alignas(64) std::int32_t cell[lanes<float>];  ///< for the lanes of `inside`
    /// Depth as in LightCell, where the shadow segments end.
    alignas(64) float depth[lanes<float>];
    std::uint32_t inside;  ///< lanes inside the grid
};

/// The cell number of each position in [0, size). A position on the line between two cells is in
/// either.
inline vreal<float> cell_number(const vreal<float>& place)
{
    return to_real<float>(to_int<float>(place - vreal<float>(0.5f)));
}

/// The depth at which shadow segments end, at the points that the light may reach.
inline vreal<float> segment_depth(const abi::LightBuffer& buffer, const RayPacket<float>& rays,
                                  const vreal<float>& t_end, const vreal<float>& ahead)
{
    return buffer.parallel ? nmadd(rays.t_min, sqrt(rays.dir2), ahead)
                           : rays.dir2 * (t_end * t_end);
}

inline LightCells cells_of(const abi::LightBuffer& buffer, const RayPacket<float>& rays,
                           const vreal<float>& t_end)
{
    const vreal<float> zero(0.0f);
    const vreal<float> size(static_cast<float>(buffer.size));
    const vreal<float> half(0.5f * static_cast<float>(buffer.size));
    const Vec3v<float> seen = buffer.parallel ? rays.org - broadcast(buffer.origin) : rays.dir;
    const vreal<float> ahead = dot(seen, broadcast(buffer.forward));
    const vreal<float> inverse =
        vreal<float>(1.0f) / (buffer.parallel ? vreal<float>(1.0f) : ahead);
    const vreal<float> column = madd(dot(seen, broadcast(buffer.across)), inverse, half);
    const vreal<float> row = madd(dot(seen, broadcast(buffer.up)), inverse, half);
    LightCells cells;
    store(cells.cell, to_int<float>(madd(cell_number(row), size, cell_number(column))));
    store(cells.depth, segment_depth(buffer, rays, t_end, ahead));
    cells.inside =
        bits((ahead > zero) & (column >= zero) & (row >= zero) & (column < size) & (row < size));
    return cells;
}

/// The bundle's cells out of `cells` with active rays that start too far from the spheres for the
/// grid to be accurate.
inline std::uint32_t cells_beyond(const abi::LightBuffer& buffer, const RayBundle<float>& bundle,
                                  std::uint32_t cells)
{
    if (!buffer.parallel)
        return 0;
    std::uint32_t beyond = 0;
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        if ((cells >> first / cell_rays & 1) == 0)
            continue;
        const Vec3v<float> d = load_rays(bundle, first).org - broadcast(buffer.origin);
        const auto near = size_of(d) <= vreal<float>(buffer.reach);
        if ((active_lanes(bundle, first) & ~bits(near)) != 0)
            beyond |= 1u << first / cell_rays;
    }
    return beyond;
}

/// Which spheres of a packet of a block occlude a ray.
inline Occlusion spheres_occlude(const LoneRay& ray, const RayBundle<float>& bundle, int number,
                                 const abi::LightBlock& block, int first)
{
    count_tests(abi::Primitive::sphere, 1);
    const SphereTest test = test_of(ray, bundle, block, first);
    SphereApproach near = approach(test.w, test.bounds.outer2, ray.rays);
    if (near.near == 0)
        return {};
    near.near &= ~bits(int_equal(load(block.surface + first), vint<float>(bundle.own[number])));
    if (near.near == 0)
        return {};
    return occludes(test, near, ray.rays, ray.scale, vreal<float>(bundle.t[number]));
}

/// Whether any sphere of a grid cell certainly occludes a ray.
inline bool is_dark(const abi::LightBuffer& buffer, const abi::LightCell& cell,
                    const abi::ShapesView& shapes, RayBundle<float>& bundle, int number)
{
    const StepScope step(abi::Step::spheres);
    record_live(all_lanes<float>);
    const LoneRay ray(bundle, number);
    for (int i = cell.first; i < cell.first + cell.count; ++i) {
        const abi::LightBlock& block = buffer.blocks[i];
        for (int first = 0; first < abi::light_block_width; first += lanes<float>) {
            if (block.surface[first] < 0)
                return false;
            const Occlusion occlusion = spheres_occlude(ray, bundle, number, block, first);
            if (occlusion.blocked != 0 ||
                blocked_by_double(bundle, number, shapes, block.surface + first,
                                  occlusion.unsure) != 0)
                return true;
        }
    }
    return false;
}

/// Ends the active rays of `cells` of a bundle that a sphere in the light buffer occludes. All rays
/// start at the light or run towards it.
[[gnu::noinline]] inline void end_in_light_buffer(const abi::LightBuffer& buffer,
                                                  const abi::ShapesView& shapes,
                                                  RayBundle<float>& bundle, std::uint32_t cells)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if ((cells >> first / cell_rays & 1) == 0 || active == 0)
            continue;
        const LightCells seen = cells_of(buffer, load_rays(bundle, first), load(bundle.t + first));
        std::uint32_t dark = 0;
        for (std::uint32_t left = active & seen.inside; left != 0; left &= left - 1) {
            const int lane = __builtin_ctz(left);
            const abi::LightCell& cell = buffer.cells[seen.cell[lane]];
            const float depth = seen.depth[lane];
            if (depth > cell.dark ||
                (depth > cell.near && is_dark(buffer, cell, shapes, bundle, first + lane)))
                dark |= left & -left;
        }
        finish_lanes(bundle, first, dark);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
