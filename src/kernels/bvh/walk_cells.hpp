#pragma once

#include "kernels/bvh/child_order.hpp"
#include "kernels/bvh/slab.hpp"
#include "kernels/stats/observe.hpp"

// A bundle of rays goes through the hierarchy as one frustum. Each node on the way is met by the
// cells that may still see it: the frustum narrows to a quarter, and to one cell, by itself as
// nodes get small against it.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Deeper than any hierarchy can make it: eight children a level, and the builder bounds the
/// levels.
inline constexpr int walk_stack = 7 * abi::bvh_levels + 8;

/// A child still to be looked at.
struct WalkEntry {
    std::uint32_t node;
    std::uint16_t slot;
    std::uint16_t cells;  ///< that may meet it
    float t_near;         ///< no ray meets it earlier
};

class WalkStack {
public:
    bool empty() const
    {
        return size_ == 0;
    }
    WalkEntry pop()
    {
        return entries_[--size_];
    }
    void push(const WalkEntry& entry)
    {
        entries_[size_++] = entry;
    }

private:
    WalkEntry entries_[walk_stack];
    int size_ = 0;
};

/// Has the memory bring a child that will be looked at soon. Addresses are integers here: a tree of
/// cells alone has no blocks, and nothing is read.
template <class Real>
inline void fetch_child(const abi::BvhView<Real>& tree, std::uint32_t child)
{
    const bool leaf = abi::is_leaf(child);
    const std::uintptr_t address =
        leaf ? reinterpret_cast<std::uintptr_t>(tree.blocks) +
                   sizeof(*tree.blocks) * (child & abi::block_mask)
             : reinterpret_cast<std::uintptr_t>(tree.nodes) + sizeof(*tree.nodes) * child;
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

/// Puts the children of a node that the cells may meet on the stack.
template <class Real>
inline void push_children(WalkStack& stack, const abi::BvhView<Real>& tree, std::uint32_t index,
                          const CellBounds& bounds, std::uint32_t cells)
{
    count_bundle_node();
    const abi::BvhNode& node = tree.nodes[index];
    const SlabHits slabs = meet_boxes(bounds, frustum_of(cells), boxes_of(node));
    if (slabs.hits == 0)
        return;
    alignas(32) float t_near[abi::node_width];
    store8(t_near, slabs.t_near);
    const ChildOrder order(slabs.hits, slabs.t_near);
    for (int i = 0; i < order.count; ++i) {
        const int slot = order.slot[i];
        fetch_child(tree, node.child[slot]);
        stack.push({index, static_cast<std::uint16_t>(slot), static_cast<std::uint16_t>(cells),
                    t_near[slot]});
    }
}

/// One child's box.
struct ChildBox {
    float low[3];
    float high[3];

    ChildBox(const abi::BvhNode& node, int slot)
        : low{node.low[0][slot], node.low[1][slot], node.low[2][slot]},
          high{node.high[0][slot], node.high[1][slot], node.high[2][slot]}
    {
    }
};

/// Rays of a cell that are better off alone than with the cell; results/tree_designs.json.
inline constexpr int few_rays = 4;

/// Takes a bundle's coherent cells through the hierarchy. `visit(child, cells)` is called for the
/// leaves that cells may meet, nearest first as far as boxes tell; where only few rays of one cell
/// may meet a child, `visit.few_rays(child, cell, rays)` takes over, and `visit.rays_of(cell,
/// low, high)` tells which. All lower the t_max of `bounds` as they find hits.
template <class Real, class Visit>
inline void walk_cells(const abi::BvhView<Real>& tree, const CellBounds& bounds,
                       std::uint32_t cells, const Visit& visit)
{
    if (cells == 0)
        return;
    WalkStack stack;
    push_children(stack, tree, 0, bounds, cells);
    while (!stack.empty()) {
        const WalkEntry entry = stack.pop();
        const abi::BvhNode& node = tree.nodes[entry.node];
        const std::uint32_t child = node.child[entry.slot];
        const ChildBox box(node, entry.slot);
        std::uint32_t open = entry.cells;
        if ((open & (open - 1)) == 0) {
            const int cell = __builtin_ctz(open);
            if (entry.t_near > bounds.t_max[cell])
                continue;
            const std::uint32_t rays = visit.rays_of(cell, box.low, box.high);
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
            push_children(stack, tree, child, bounds, open);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
