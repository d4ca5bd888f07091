#include "bvh/split.hpp"

#include <tbb/concurrent_vector.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>

namespace packtrace {
namespace {

constexpr std::size_t leaf_items = abi::node_width;

/// Below this level every range is halved by number, so that no scene makes a deep BVH. With eight
/// children in each node, balanced BVHs are far less deep.
constexpr int heuristic_levels = 24;

/// Subtrees of more items are built in tasks of their own: enough work for a task to be worth its
/// start.
constexpr std::size_t task_items = 2048;

/// A node's children while it is built.
struct NodeChildren {
    std::array<BvhRange, abi::node_width> range;
    std::size_t count = 0;
};

class Builder {
public:
    explicit Builder(std::span<BvhItem> items) : items_(items), leaf_count_(items.size(), 0)
    {
    }

    Bvh build()
    {
        const BvhRange all = range_of(items_, 0, items_.size());
        nodes_.grow_by(1);
        if (is_leaf(all)) {
            NodeChildren only;
            only.range[only.count++] = all;
            fill_node(0, only, 0);
        } else {
            build_node(0, all, 0);
        }
        tasks_.wait();
        return finish();
    }

private:
    [[nodiscard]] bool is_leaf(const BvhRange& range) const
    {
        return range.count() <= leaf_items && one_kind(range);
    }

    [[nodiscard]] bool one_kind(const BvhRange& range) const
    {
        const auto members = items_.subspan(range.begin, range.count());
        return std::all_of(members.begin(), members.end(),
                           [&](const BvhItem& item) { return item.kind == members.front().kind; });
    }

    [[nodiscard]] std::pair<BvhRange, BvhRange> halve(const BvhRange& range, int level)
    {
        if (range.count() <= leaf_items)
            return split_kinds(items_, range);
        return level < heuristic_levels ? split(items_, range) : split_number(items_, range);
    }

    /// The largest child that is no leaf, by area, or by number below the heuristic's levels; null
    /// if all are leaves.
    [[nodiscard]] BvhRange* largest_child(NodeChildren& children, int level) const
    {
        BvhRange* largest = nullptr;
        float size = -1.0f;
        for (BvhRange& child : std::span(children.range).first(children.count)) {
            const float child_size =
                level < heuristic_levels ? half_area(child.box) : static_cast<float>(child.count());
            if (!is_leaf(child) && child_size > size) {
                size = child_size;
                largest = &child;
            }
        }
        return largest;
    }

    /// Splits the largest child until there are eight, or only leaves.
    [[nodiscard]] NodeChildren divide(const BvhRange& range, int level)
    {
        NodeChildren children;
        children.range[children.count++] = range;
        while (children.count < children.range.size()) {
            BvhRange* const largest = largest_child(children, level);
            if (largest == nullptr)
                break;
            const auto [lower, upper] = halve(*largest, level);
            *largest = lower;
            children.range[children.count++] = upper;
        }
        return children;
    }

    void build_node(std::uint32_t index, const BvhRange& range, int level)
    {
        fill_node(index, divide(range, level), level);
    }

    void fill_node(std::uint32_t index, const NodeChildren& children, int level)
    {
        abi::BvhNode node;
        for (std::size_t slot = 0; slot < abi::node_width; ++slot) {
            const BvhRange absent;
            const BvhRange& range = slot < children.count ? children.range[slot] : absent;
            for (int axis = 0; axis < 3; ++axis) {
                node.low[axis][slot] = range.box.low[axis];
                node.high[axis][slot] = range.box.high[axis];
            }
            node.child[slot] = slot < children.count ? make_child(range, level + 1) : abi::leaf_bit;
        }
        nodes_[index] = node;
    }

    /// Makes a leaf or a node; returns the child's value in its node. For a leaf that is leaf_bit |
    /// its first item, until finish().
    [[nodiscard]] std::uint32_t make_child(const BvhRange& range, int level)
    {
        if (is_leaf(range)) {
            sort_by_number(range);
            leaf_count_[range.begin] = static_cast<std::uint8_t>(range.count());
            return abi::leaf_bit | static_cast<std::uint32_t>(range.begin);
        }
        const auto index = static_cast<std::uint32_t>(nodes_.grow_by(1) - nodes_.begin());
        if (range.count() > task_items)
            tasks_.run([this, index, range, level] { build_node(index, range, level); });
        else
            build_node(index, range, level);
        return index;
    }

    /// Makes the order in a leaf independent of how it was found.
    void sort_by_number(const BvhRange& range)
    {
        const auto members = items_.subspan(range.begin, range.count());
        std::sort(members.begin(), members.end(),
                  [](const BvhItem& a, const BvhItem& b) { return a.number < b.number; });
    }

    /// Numbers the leaves along the items, and the nodes depth first. Neither depends on the order
    /// in which threads built them.
    [[nodiscard]] Bvh finish()
    {
        Bvh bvh;
        std::vector<std::uint32_t> leaf_number(items_.size());
        bvh.order.reserve(items_.size());
        for (std::size_t i = 0; i < items_.size(); ++i) {
            bvh.order.push_back(items_[i].number);
            if (leaf_count_[i] == 0)
                continue;
            leaf_number[i] = static_cast<std::uint32_t>(bvh.leaves.size());
            bvh.leaves.push_back({static_cast<std::uint32_t>(i), leaf_count_[i], items_[i].kind});
        }
        bvh.nodes.reserve(nodes_.size());
        place_node(bvh, 0, leaf_number);
        return bvh;
    }

    std::uint32_t place_node(Bvh& bvh, std::uint32_t from,
                             const std::vector<std::uint32_t>& leaf_number) const
    {
        const auto at = static_cast<std::uint32_t>(bvh.nodes.size());
        bvh.nodes.push_back(nodes_[from]);
        for (int slot = 0; slot < abi::node_width; ++slot) {
            const std::uint32_t child = nodes_[from].child[slot];
            if (!abi::is_leaf(child))
                bvh.nodes[at].child[slot] = place_node(bvh, child, leaf_number);
            else if (nodes_[from].low[0][slot] <= nodes_[from].high[0][slot])
                bvh.nodes[at].child[slot] = abi::leaf_bit | leaf_number[child & ~abi::leaf_bit];
        }
        return at;
    }

    std::span<BvhItem> items_;
    std::vector<std::uint8_t> leaf_count_;  ///< by first item of a leaf, 0 elsewhere
    tbb::concurrent_vector<abi::BvhNode> nodes_;
    tbb::task_group tasks_;
};

}  // namespace

Bvh build_bvh(std::span<BvhItem> items)
{
    if (items.empty())
        return {};
    return Builder(items).build();
}

}  // namespace packtrace
