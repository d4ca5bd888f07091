#pragma once

#include "kernels/slab.hpp"

// A group of rays goes through the hierarchy as one beam. Each node on the way is met by the
// cells that may still see it: the beam narrows to a quarter, and to one cell, by itself as
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
    int size() const
    {
        return size_;
    }
    /// Puts `entry` in above `bottom`, so that nearer ones come out earlier.
    void insert(int bottom, const WalkEntry& entry)
    {
        int at = size_++;
        for (; at > bottom && entries_[at - 1].t_near < entry.t_near; --at)
            entries_[at] = entries_[at - 1];
        entries_[at] = entry;
    }

private:
    WalkEntry entries_[walk_stack];
    int size_ = 0;
};

/// Puts the children of a node that the cells may meet on the stack.
inline void push_children(WalkStack& stack, const abi::BvhNode* nodes, std::uint32_t index,
                          const CellBounds& bounds, std::uint32_t cells)
{
    const abi::BvhNode& node = nodes[index];
    const SlabHits slabs = meet_boxes(bounds, beam_of(cells), boxes_of(node));
    if (slabs.hits == 0)
        return;
    alignas(32) float t_near[abi::node_width];
    store8(t_near, slabs.t_near);
    const int bottom = stack.size();
    for (std::uint32_t left = slabs.hits; left != 0; left &= left - 1) {
        const auto slot = static_cast<std::uint16_t>(__builtin_ctz(left));
        stack.insert(bottom, {index, slot, static_cast<std::uint16_t>(cells), t_near[slot]});
    }
}

/// The entry's cells that nothing nearer hides it from by now.
inline std::uint32_t still_open(const WalkEntry& entry, const abi::BvhNode* nodes,
                                const CellBounds& bounds)
{
    const std::uint32_t cells = entry.cells;
    if ((cells & (cells - 1)) == 0)
        return entry.t_near <= bounds.t_max[__builtin_ctz(cells)] ? cells : 0;
    const abi::BvhNode& node = nodes[entry.node];
    const float low[3] = {node.low[0][entry.slot], node.low[1][entry.slot],
                          node.low[2][entry.slot]};
    const float high[3] = {node.high[0][entry.slot], node.high[1][entry.slot],
                           node.high[2][entry.slot]};
    return meet_cells(bounds, low, high, cells);
}

/// Calls `leaf(child, cells)` for the leaves that cells may meet, nearest first as far as
/// boxes tell. `leaf` lowers the t_max of `bounds` as it finds hits.
template <class Leaf>
inline void walk_cells(const abi::BvhNode* nodes, const CellBounds& bounds, std::uint32_t cells,
                       const Leaf& leaf)
{
    if (cells == 0)
        return;
    WalkStack stack;
    push_children(stack, nodes, 0, bounds, cells);
    while (!stack.empty()) {
        const WalkEntry entry = stack.pop();
        const std::uint32_t open = still_open(entry, nodes, bounds);
        if (open == 0)
            continue;
        const std::uint32_t child = nodes[entry.node].child[entry.slot];
        if (abi::is_leaf(child))
            leaf(child, open);
        else
            push_children(stack, nodes, child, bounds, open);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
