#pragma once

#include "kernels/bvh/child_order.hpp"
#include "kernels/bvh/slab.hpp"
#include "kernels/stats/observe.hpp"

// A bundle of rays traverses the BVH as one frustum. Each node is tested against the cells that may
// still hit it, so the frustum narrows to a quarter and then to one cell as nodes get smaller.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Enough entries for any BVH: a level adds at most seven, and the builder bounds the number of
/// levels.
inline constexpr int walk_stack = 7 * abi::bvh_levels + 8;

/// A child that is still to be visited.
struct WalkEntry {
    std::uint32_t node;
    std::uint16_t slot;
    std::uint16_t cells;  ///< cells that may hit it
    float t_near;         ///< no ray enters it before
};

class WalkStack {
public:
    bool empty() const
    {
        return entry_count_ == 0;
    }
    WalkEntry pop()
    {
        return entries_[--entry_count_];
    }
    void push(const WalkEntry& entry)
    {
        entries_[entry_count_++] = entry;
    }

private:
    WalkEntry entries_[walk_stack];
    int entry_count_ = 0;
};

/// Prefetches a child that will be visited soon. Addresses are computed as integers, because a BVH
/// without spheres has no blocks; nothing is read.
template <class Real>
inline void fetch_child(const abi::BvhView<Real>& bvh, std::uint32_t child)
{
    const bool leaf = abi::is_leaf(child);
    const std::uintptr_t address =
        leaf ? reinterpret_cast<std::uintptr_t>(bvh.blocks) +
                   sizeof(*bvh.blocks) * (child & abi::block_mask)
             : reinterpret_cast<std::uintptr_t>(bvh.nodes) + sizeof(*bvh.nodes) * child;
    const auto fetch = [address](int line) {
        __builtin_prefetch(
            reinterpret_cast<const char*>(address + 64u * static_cast<unsigned>(line)));
    };
    fetch(0);
    fetch(1);
    if (leaf)
        return;
    fetch(2);
    fetch(3);
}

/// Pushes the children of a node that the cells may hit.
template <class Real>
inline void push_children(WalkStack& stack, const abi::BvhView<Real>& bvh, std::uint32_t index,
                          const CellBounds& bounds, std::uint32_t cells)
{
    count_bundle_node();
    const abi::BvhNode& node = bvh.nodes[index];
    const SlabHits slabs = meet_boxes(bounds, frustum_of(cells), boxes_of(node));
    if (slabs.hits == 0)
        return;
    alignas(32) float t_near[abi::node_width];
    store8(t_near, slabs.t_near);
    const ChildOrder order(slabs.hits, slabs.t_near);
    for (int i = 0; i < order.count; ++i) {
        const int slot = order.slot[i];
        fetch_child(bvh, node.child[slot]);
        stack.push({index, static_cast<std::uint16_t>(slot), static_cast<std::uint16_t>(cells),
                    t_near[slot]});
    }
}

/// The box of one child.
struct ChildBox {
    float low[3];
    float high[3];

    ChildBox(const abi::BvhNode& node, int slot)
        : low{node.low[0][slot], node.low[1][slot], node.low[2][slot]},
          high{node.high[0][slot], node.high[1][slot], node.high[2][slot]}
    {
    }
};

/// Up to this many rays of a cell are traversed alone, which is then faster;
/// results/tree_designs.json.
inline constexpr int few_rays = 4;

/// Traverses the BVH with a bundle's coherent cells. `visit(child, cells)` is called for the leaves
/// that cells may hit, nearest first as far as boxes tell. If only few rays of one cell may hit a
/// child, `visit.few_rays(child, cell, rays)` is called instead; `rays_of(cell, low, high)` returns
/// the rays of a cell that may hit a box (CellRays). `visit` reduces the t_max of `bounds` when it
/// finds hits.
template <class Real, class RaysOf, class Visit>
inline void walk_cells(const abi::BvhView<Real>& bvh, const CellBounds& bounds, std::uint32_t cells,
                       const RaysOf& rays_of, const Visit& visit)
{
    if (cells == 0)
        return;
    WalkStack stack;
    push_children(stack, bvh, 0, bounds, cells);
    while (!stack.empty()) {
        const WalkEntry entry = stack.pop();
        const abi::BvhNode& node = bvh.nodes[entry.node];
        const std::uint32_t child = node.child[entry.slot];
        const ChildBox box(node, entry.slot);
        std::uint32_t open = entry.cells;
        if ((open & (open - 1)) == 0) {
            const int cell = __builtin_ctz(open);
            if (entry.t_near > bounds.t_max[cell])
                continue;
            const std::uint32_t rays = rays_of(cell, box.low, box.high);
            if (__builtin_popcount(rays) <= few_rays) {
                if (rays != 0)
                    visit.few_rays(child, cell, rays);
                continue;
            }
        } else {
            open = meet_cells(bounds, box.low, box.high, open);
            if (open == 0)
                continue;
        }
        if (abi::is_leaf(child))
            visit(child, open);
        else
            push_children(stack, bvh, child, bounds, open);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
