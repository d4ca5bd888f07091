#pragma once

#include "kernel_abi/light_buffer.hpp"
#include "kernels/bvh/occluded_ray.hpp"

// What stands in the way of a bundle of rays from one point light, or towards one light from a
// direction, by the light's own view of the hierarchy's spheres in place of the hierarchy.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where the rays of a packet lie in the grid, in cells.
struct LightCells {
    alignas(64) float column[lanes<float>];
    alignas(64) float row[lanes<float>];
    alignas(64) float depth[lanes<float>];  ///< as LightCell::near has it
    std::uint32_t inside;                   ///< the lanes that any cell sees
};

inline LightCells cells_of(const abi::LightBuffer& buffer, const RayPacket<float>& rays)
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
    store(cells.column, column);
    store(cells.row, row);
    store(cells.depth, buffer.parallel ? ahead : rays.dir2);
    cells.inside =
        bits((ahead > zero) & (column >= zero) & (row >= zero) & (column < size) & (row < size));
    return cells;
}

/// The cells of a bundle, out of `cells`, with active rays that start too far from the spheres for
/// the grid to tell where they pass.
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
        const auto near = abs(d.x) + abs(d.y) + abs(d.z) <= vreal<float>(buffer.reach);
        if ((active_lanes(bundle, first) & ~bits(near)) != 0)
            beyond |= 1u << first / cell_rays;
    }
    return beyond;
}

inline const abi::LightCell& cell_at(const abi::LightBuffer& buffer, const LightCells& cells,
                                     int lane)
{
    return buffer.cells[static_cast<int>(cells.row[lane]) * buffer.size +
                        static_cast<int>(cells.column[lane])];
}

/// What a packet of a block's spheres does to a ray.
inline Occlusion spheres_occlude(const LoneRay& ray, const RayBundle<float>& bundle, int number,
                                 const abi::LightBlock& block, int first)
{
    count_tests(abi::Primitive::sphere, 1);
    const SphereTest test = test_of(ray, bundle, block, first);
    SphereApproach near = approach(test.w, test.bounds.outer2, ray.rays);
    near.near &= ~bits(int_equal(load(block.surface + first), vint<float>(bundle.own[number])));
    if (near.near == 0)
        return {};
    return occludes(test, near, ray.rays, ray.scale, vreal<float>(bundle.t[number]));
}

/// The ray against the spheres of its cell.
inline void occluders_in_cell(const abi::LightBuffer& buffer, const abi::LightCell& cell,
                              const abi::ShapesView& shapes, RayBundle<float>& bundle, int number,
                              const Occluder& occluder)
{
    const PartScope part(abi::Part::spheres);
    tell_live(all_lanes<float>);
    const LoneRay ray(bundle, number);
    for (int i = cell.first; i < cell.first + cell.count; ++i) {
        const abi::LightBlock& block = buffer.blocks[i];
        for (int first = 0; first < abi::light_block_width; first += lanes<float>) {
            const Occlusion occlusion = spheres_occlude(ray, bundle, number, block, first);
            std::uint32_t blocked = occlusion.blocked;
            if (blocked == 0)
                blocked = blocked_by_double(bundle, number, shapes, block.surface + first,
                                            occlusion.unsure);
            if (blocked != 0 &&
                !goes_behind(bundle, number, block.surface[first + __builtin_ctz(blocked)],
                             occluder))
                return;
        }
    }
}

/// Meets the active rays of `cells` of a bundle, which all start at the light or run towards it,
/// with what blocks them among the spheres that the light sees.
[[gnu::noinline]] inline void occluders_in_light_buffer(const abi::LightBuffer& buffer,
                                                        const abi::ShapesView& shapes,
                                                        RayBundle<float>& bundle,
                                                        std::uint32_t cells,
                                                        const Occluder& occluder)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if ((cells >> first / cell_rays & 1) == 0 || active == 0)
            continue;
        const LightCells seen = cells_of(buffer, load_rays(bundle, first));
        for (std::uint32_t left = active & seen.inside; left != 0; left &= left - 1) {
            const int lane = __builtin_ctz(left);
            const abi::LightCell& cell = cell_at(buffer, seen, lane);
            if (seen.depth[lane] > cell.near)
                occluders_in_cell(buffer, cell, shapes, bundle, first + lane, occluder);
        }
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
