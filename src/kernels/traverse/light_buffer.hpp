#pragma once

#include "kernel_abi/light_buffer.hpp"
#include "kernels/traverse/occluded_ray.hpp"

// What stands in the way of a bundle of rays from one point light, by the light's own view of the
// hierarchy's spheres in place of the hierarchy.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where the rays of a packet lie in the grid, in cells.
struct LightCells {
    alignas(64) float column[lanes<float>];
    alignas(64) float row[lanes<float>];
    std::uint32_t inside;  ///< the lanes that any cell sees
};

inline LightCells cells_of(const abi::LightBuffer& buffer, const Vec3v<float>& direction)
{
    const vreal<float> zero(0.0f);
    const vreal<float> size(static_cast<float>(buffer.size));
    const vreal<float> half(0.5f * static_cast<float>(buffer.size));
    const vreal<float> ahead = dot(direction, broadcast(buffer.forward));
    const vreal<float> inverse = vreal<float>(1.0f) / ahead;
    const vreal<float> column = madd(dot(direction, broadcast(buffer.across)), inverse, half);
    const vreal<float> row = madd(dot(direction, broadcast(buffer.up)), inverse, half);
    LightCells cells;
    store(cells.column, column);
    store(cells.row, row);
    cells.inside =
        bits((ahead > zero) & (column >= zero) & (row >= zero) & (column < size) & (row < size));
    return cells;
}

inline const abi::LightCell& cell_at(const abi::LightBuffer& buffer, const LightCells& cells,
                                     int lane)
{
    return buffer.cells[static_cast<int>(cells.row[lane]) * buffer.size +
                        static_cast<int>(cells.column[lane])];
}

/// One ray in every lane, and its scale.
struct LightRay {
    RayPacket<float> rays;
    RayScale scale;
    vreal<float> t_end;
    vint<float> own;

    LightRay(const RayBundle<float>& bundle, int ray)
        : rays(broadcast_ray(bundle, ray)),
          scale(rays, vreal<float>(bundle.inverse[ray])),
          t_end(bundle.t[ray]),
          own(bundle.own[ray])
    {
    }
};

/// What a packet of a block's spheres does to a ray.
inline Occlusion spheres_occlude(const LightRay& ray, const RayBundle<float>& bundle,
                                 const abi::LightBlock& block, int first)
{
    count_tests(abi::Primitive::sphere, 1);
    const vreal<float> radius = load(block.radius + first);
    const Vec3v<float> w =
        ray.rays.org - Vec3v<float>{load(block.center[0] + first), load(block.center[1] + first),
                                    load(block.center[2] + first)};
    SphereApproach near = approach(w, leaf_outer2(bundle, radius), ray.rays);
    near.near &= ~bits(int_equal(load(block.surface + first), ray.own));
    if (near.near == 0)
        return {};
    return occludes({w, radius * radius, leaf_bounds(bundle, radius)}, near, ray.rays, ray.scale,
                    ray.t_end);
}

/// The ray against the spheres of its cell.
template <class Occluder>
inline void occluders_in_cell(const abi::LightBuffer& buffer, const abi::LightCell& cell,
                              const abi::ShapesView& shapes, RayBundle<float>& bundle, int number,
                              const Occluder& occluder)
{
    const PartScope part(abi::Part::spheres);
    tell_live(all_lanes<float>);
    const LightRay ray(bundle, number);
    for (int i = cell.first; i < cell.first + cell.count; ++i) {
        const abi::LightBlock& block = buffer.blocks[i];
        for (int first = 0; first < abi::light_block_width; first += lanes<float>) {
            Occlusion occlusion = spheres_occlude(ray, bundle, block, first);
            for (; occlusion.blocked == 0 && occlusion.unsure != 0;
                 occlusion.unsure &= occlusion.unsure - 1) {
                const int slot = __builtin_ctz(occlusion.unsure);
                const InTheWay in_double =
                    is_in_the_way(shapes, block.surface[first + slot], bundle, number);
                if (in_double == InTheWay::yes)
                    occlusion.blocked = 1u << slot;
                else if (in_double == InTheWay::undecided)
                    doubt_ray(bundle, number, occlusion.unsure & -occlusion.unsure);
            }
            if (occlusion.blocked != 0 &&
                !goes_behind(bundle, number,
                             block.surface[first + __builtin_ctz(occlusion.blocked)], occluder))
                return;
        }
    }
}

/// Meets the active rays of `cells` of a bundle, which all start at the light, with what blocks
/// them among the spheres that the light sees.
template <class Occluder>
[[gnu::noinline]] void occluders_in_light_buffer(const abi::LightBuffer& buffer,
                                                 const abi::ShapesView& shapes,
                                                 RayBundle<float>& bundle, std::uint32_t cells,
                                                 const Occluder& occluder)
{
    for (int first = 0; first < bundle_rays; first += lanes<float>) {
        const std::uint32_t active = active_lanes(bundle, first);
        if ((cells >> first / cell_rays & 1) == 0 || active == 0)
            continue;
        const RayPacket<float> rays = load_rays(bundle, first);
        const LightCells seen = cells_of(buffer, rays.dir);
        alignas(64) float length2[lanes<float>];
        store(length2, rays.dir2);
        for (std::uint32_t left = active & seen.inside; left != 0; left &= left - 1) {
            const int lane = __builtin_ctz(left);
            const abi::LightCell& cell = cell_at(buffer, seen, lane);
            if (length2[lane] > cell.near2)
                occluders_in_cell(buffer, cell, shapes, bundle, first + lane, occluder);
        }
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
