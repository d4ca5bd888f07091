#pragma once

#include "kernels/bvh/bundle.hpp"
#include "kernels/geometry/kinds.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// The spheres of a leaf and their surface numbers, which only hits read.
template <class Real>
struct SphereLeaf {
    const abi::SphereBlock<Real>& block;
    const std::int32_t* surface;

    [[nodiscard]] std::int32_t surface_of(int slot) const
    {
        return surface[slot];
    }
};

/// Makes a block from the shapes of its spheres.
template <class Real>
[[gnu::noinline]] void gather_block(const abi::BvhView<Real>& bvh, const std::int32_t* surfaces,
                                    abi::SphereBlock<Real>& block)
{
    for (int slot = 0; slot < abi::node_width; ++slot) {
        const bool used = surfaces[slot] >= 0;
        constexpr double far = abi::largest_coordinate;
        const abi::SphereShape nowhere{{far, far, far}, -1.0};
        const abi::SphereShape& sphere =
            used ? bvh.shapes->spheres[bvh.shapes->index[surfaces[slot]].record] : nowhere;
        for (int axis = 0; axis < 3; ++axis)
            block.center[axis][slot] = static_cast<Real>(sphere.center[axis]);
        block.radius[slot] = static_cast<Real>(sphere.radius);
    }
}

/// The spheres of a leaf. `gathered` is used if the block has to be made.
template <class Real>
inline SphereLeaf<Real> sphere_leaf(const abi::BvhView<Real>& bvh, std::uint32_t child,
                                    abi::SphereBlock<Real>& gathered)
{
    const std::uint32_t index = child & abi::block_mask;
    const std::int32_t* const surfaces = bvh.block_surfaces + std::size_t{index} * abi::node_width;
    if (sizeof(Real) == sizeof(float) || bvh.blocks != nullptr)
        return {bvh.blocks[index], surfaces};
    gather_block(bvh, surfaces, gathered);
    return {gathered, surfaces};
}

/// One record of `records`, or its shape if records are not kept for rays in double.
template <class Real, template <class> class Record>
inline const Record<Real>& record_or_shape(const Record<Real>* records, int number,
                                           const Record<double>& shape)
{
    if constexpr (sizeof(Real) == sizeof(double))
        if (records == nullptr)
            return shape;
    return records[number];
}

/// The kind of all objects of a run, by the number of any of them.
template <class Real>
inline abi::Primitive primitive_of_run(const abi::BvhView<Real>& bvh, int number)
{
    return number < bvh.quadric_count ? Quadric::primitive : Polygon::primitive;
}

/// Returns `visit(record, shape)` for one object of a run.
template <class Real, class Visit>
inline auto with_object_of_run(const abi::BvhView<Real>& bvh, int number, const Visit& visit)
{
    const abi::ShapesView& shapes = *bvh.shapes;
    const abi::SurfaceIndex& index = shapes.index[bvh.run_surfaces[number]];
    if (number < bvh.quadric_count) {
        const abi::QuadricRecord<double>& shape = shapes.quadrics[index.record];
        return visit(record_or_shape<Real>(bvh.quadrics, number, shape), shape);
    }
    const abi::PolygonRecord<double>& shape = shapes.polygons[index.record];
    return visit(record_or_shape<Real>(bvh.polygons, number - bvh.quadric_count, shape), shape);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
