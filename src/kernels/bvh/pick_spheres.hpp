#pragma once

#include "kernels/bvh/block_ray.hpp"
#include "kernels/lists/object_sets.hpp"

// Picks the spheres of a BVH that the rays of a cone may hit into lists. If they are few, testing
// packets against lists is faster than traversing the BVH.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// In a larger BVH, tiles mostly hit too many objects for a try to pay.
inline constexpr int most_picking_nodes = 1000;
/// The largest numbers of nodes and leaves that are visited.
inline constexpr int most_open_nodes = 48;
inline constexpr int most_open_leaves = 64;

/// A bit for each child of a node, or sphere of a leaf, for which `meets(first)` is true; it tests
/// a packet from `first` on.
template <class Meets>
inline std::uint32_t each_met(const Meets& meets)
{
    std::uint32_t met = 0;
    for (int first = 0; first < abi::node_width; first += lanes<float>)
        met |= (bits(meets(first)) & all_lanes<float>) << first;
    return met & ((1u << abi::node_width) - 1);
}

inline Vec3v<float> load_points(const float (&of)[3][abi::node_width], int first)
{
    return {load_of_block(of[0], first), load_of_block(of[1], first), load_of_block(of[2], first)};
}

/// The children of a node whose boxes the rays of a cone may hit, judged by the balls around the
/// boxes.
inline std::uint32_t children_met(const Cone<float>& cone, const abi::BvhNode& node)
{
    const Vec3v<float> base = broadcast(cone.base);
    return each_met([&](int first) {
        const Vec3v<float> high = load_points(node.high, first);
        const Vec3v<float> center =
            scale<float>(vreal<float>(0.5f), load_points(node.low, first) + high);
        const Vec3v<float> edge = high - center;
        return may_meet<float>(cone, center - base, sqrt(dot(edge, edge)));
    });
}

/// Spheres of a leaf, side by side.
struct LeafPacket {
    Vec3v<float> center;
    vreal<float> radius;

    LeafPacket(const abi::SphereBlock<float>& block, int first)
        : center(load_points(block.center, first)), radius(load_of_block(block.radius, first))
    {
    }
};

/// The spheres of a leaf that the rays of a cone may hit. `error` is the rounding error of their
/// centres.
inline std::uint32_t spheres_met(const Cone<float>& cone, const abi::SphereBlock<float>& block,
                                 const vreal<float>& error)
{
    const Vec3v<float> base = broadcast(cone.base);
    return each_met([&](int first) {
        const LeafPacket spheres(block, first);
        return (spheres.radius >= vreal<float>(0.0f)) &
               may_meet<float>(cone, spheres.center - base, spheres.radius + error);
    });
}

/// Picked spheres of one leaf.
struct PickedLeaf {
    std::uint32_t block;
    std::uint32_t spheres;
};

/// The spheres of a BVH that a cone's rays may hit.
struct PickedLeaves {
    PickedLeaf leaves[most_picked_spheres];
    int count = 0;
    int spheres = 0;

    /// Returns false if there are too many.
    bool add(std::uint32_t block, std::uint32_t met)
    {
        spheres += __builtin_popcount(met);
        if (met != 0 && spheres <= most_picked_spheres)
            leaves[count++] = {block, met};
        return spheres <= most_picked_spheres;
    }
};

/// Finds the objects of a BVH that the rays of a cone may hit. Returns false if they are many, or
/// not only spheres.
inline bool find_few(PickedLeaves& picked, const Cone<float>& cone, const abi::BvhView<float>& bvh)
{
    std::uint32_t open[most_open_nodes + abi::node_width] = {0};
    const vreal<float> error(bvh.center_error);
    int next = 0;
    int end = 1;
    int leaves = 0;
    while (next < end) {
        const abi::BvhNode& node = bvh.nodes[open[next++]];
        for (std::uint32_t met = children_met(cone, node); met != 0; met &= met - 1) {
            const std::uint32_t child = node.child[__builtin_ctz(met)];
            if (!abi::is_leaf(child)) {
                open[end++] = child;
                continue;
            }
            const std::uint32_t block = child & abi::block_mask;
            if (abi::is_run(child) || ++leaves > most_open_leaves ||
                !picked.add(block, spheres_met(cone, bvh.blocks[block], error)))
                return false;
        }
        if (end > most_open_nodes)
            return false;
    }
    return true;
}

/// Appends spheres of a leaf to a list, for rays from `origins`. With a shared origin, the list
/// stores origins relative to centres.
template <Origin O>
inline void append_leaf(SphereFilters& list, const Origins& origins, const abi::BvhView<float>& bvh,
                        const PickedLeaf& leaf)
{
    const std::int32_t* const surfaces =
        bvh.block_surfaces + std::size_t{leaf.block} * abi::node_width;
    const vreal<float> error(bvh.center_error);
    for (int first = 0; first < abi::node_width; first += lanes<float>) {
        const std::uint32_t kept = leaf.spheres >> first & all_lanes<float>;
        if (kept == 0)
            continue;
        const LeafPacket spheres(bvh.blocks[leaf.block], first);
        const Vec3v<float> w = broadcast(origins.center) - spheres.center;
        append_certain(list, kept,
                       {O == Origin::shared ? w : spheres.center, w, spheres.radius,
                        spheres.radius * spheres.radius, error},
                       origins);
        for (std::uint32_t left = kept; left != 0; left &= left - 1)
            list.surface[list.count++] = surfaces[first + __builtin_ctz(left)];
    }
}

/// Adds the spheres of a BVH that rays of `cone` from `origins` may hit to the objects of the lists
/// that they may hit. Returns false, and adds nothing, if these are too many.
template <Origin O>
[[gnu::noinline]] bool pick_spheres(FilteredObjects<O>& objects, const Origins& origins,
                                    const Cone<float>& cone, const abi::BvhView<float>& bvh)
{
    PickedLeaves picked;
    if (!cone.bounded || bvh.node_count > most_picking_nodes || !find_few(picked, cone, bvh))
        return false;
    SphereFilters& list = list_of<Sphere>(objects);
    for (int i = 0; i < picked.count; ++i)
        append_leaf<O>(list, origins, bvh, picked.leaves[i]);
    objects.count += picked.spheres;
    if (objects.count == 1 && list.count == 1)
        objects.one = body_of(object_at(list, 0));
    return true;
}

/// `objects` holds what rays of `cone`, which start at one point, may hit outside the BVH. Adds
/// what they may hit in it. Returns false if the rays have to traverse the BVH.
template <abi::Features F, class Real>
inline bool picks_all(FromPoint<F, Real>& objects, const Cone<Real>& cone,
                      const abi::SceneView<Real>& scene)
{
    if (scene.tree.empty())
        return true;
    if constexpr (F.exact)
        return pick_spheres<Origin::shared>(objects, origins_at(cone.base), cone, scene.tree);
    else
        return false;
}

/// The same for rays from a box.
template <abi::Features F, class Real>
inline bool picks_all(FromAnywhere<F, Real>& objects, const Box<Real>& box, const Cone<Real>& cone,
                      const abi::SceneView<Real>& scene)
{
    if (scene.tree.empty())
        return true;
    if constexpr (F.exact)
        return pick_spheres<Origin::any>(objects, origins_in(box.low, box.high), cone, scene.tree);
    else
        return false;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
