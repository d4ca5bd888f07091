#pragma once

#include "kernels/bvh/bundle.hpp"
#include "kernels/geometry/kinds.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// The spheres of a leaf, and their surface numbers, which only hits ask for.
template <class Real>
struct SphereLeaf {
    const abi::SphereBlock<Real>& block;
    const std::int32_t* surface;

    [[nodiscard]] std::int32_t surface_of(int slot) const
    {
        return surface[slot];
    }
};

/// Makes a block of its spheres' shapes.
template <class Real>
[[gnu::noinline]] void gather_block(const abi::BvhView<Real>& tree, const std::int32_t* surfaces,
                                    abi::SphereBlock<Real>& block)
{
    for (int slot = 0; slot < abi::node_width; ++slot) {
        const bool used = surfaces[slot] >= 0;
        constexpr double far = abi::largest_coordinate;
        const abi::SphereShape nowhere{{far, far, far}, -1.0};
        const abi::SphereShape& sphere =
            used ? tree.shapes->spheres[tree.shapes->index[surfaces[slot]].record] : nowhere;
        for (int axis = 0; axis < 3; ++axis)
            block.center[axis][slot] = static_cast<Real>(sphere.center[axis]);
        block.radius[slot] = static_cast<Real>(sphere.radius);
    }
}

/// `room` is for a block that has to be made.
template <class Real>
inline SphereLeaf<Real> sphere_leaf(const abi::BvhView<Real>& tree, std::uint32_t child,
                                    abi::SphereBlock<Real>& room)
{
    const std::uint32_t index = child & abi::block_mask;
    const std::int32_t* const surfaces = tree.block_surfaces + std::size_t{index} * abi::node_width;
    if (sizeof(Real) == sizeof(float) || tree.blocks != nullptr)
        return {tree.blocks[index], surfaces};
    gather_block(tree, surfaces, room);
    return {room, surfaces};
}

/// One record of `records`, or its shape where those are not kept for rays in double.
template <class Real, template <class> class Record>
inline const Record<Real>& record_or_shape(const Record<Real>* records, int number,
                                           const Record<double>& shape)
{
    if constexpr (sizeof(Real) == sizeof(double))
        if (records == nullptr)
            return shape;
    return records[number];
}

/// The kind of all objects of a run, by the number of any.
template <class Real>
inline abi::Primitive primitive_of_run(const abi::BvhView<Real>& tree, int number)
{
    return number < tree.quadric_count ? Quadric::primitive : Polygon::primitive;
}

/// `visit(record, shape)` of an object of a run.
template <class Real, class Visit>
inline auto with_object_of_run(const abi::BvhView<Real>& tree, int number, const Visit& visit)
{
    const abi::ShapesView& shapes = *tree.shapes;
    const abi::SurfaceIndex& index = shapes.index[tree.run_surfaces[number]];
    if (number < tree.quadric_count) {
        const abi::QuadricRecord<double>& shape = shapes.quadrics[index.record];
        return visit(record_or_shape<Real>(tree.quadrics, number, shape), shape);
    }
    const abi::PolygonRecord<double>& shape = shapes.polygons[index.record];
    return visit(record_or_shape<Real>(tree.polygons, number - tree.quadric_count, shape), shape);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
