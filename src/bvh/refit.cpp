#include "bvh/bvh.hpp"

#include <cstddef>
#include <vector>

namespace packtrace {
namespace {

bool is_present(const abi::BvhNode& node, std::size_t slot)
{
    return node.low[0][slot] <= node.high[0][slot];
}

Box4 box_in(const abi::BvhNode& node, std::size_t slot)
{
    Box4 box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = node.low[axis][slot];
        box.high[axis] = node.high[axis][slot];
    }
    return box;
}

void set_box(abi::BvhNode& node, std::size_t slot, const Box4& box)
{
    for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][slot] = box.low[axis];
        node.high[axis][slot] = box.high[axis];
    }
}

}  // namespace

void refit_bvh(Bvh& bvh, std::span<const Box4> leaf_boxes)
{
    std::vector<Box4> boxes(bvh.nodes.size());
    // From the last node: children come after their node.
    for (std::size_t i = bvh.nodes.size(); i-- > 0;) {
        abi::BvhNode& node = bvh.nodes[i];
        for (std::size_t slot = 0; slot < abi::node_width; ++slot) {
            if (!is_present(node, slot))
                continue;
            const std::uint32_t child = node.child[slot];
            const Box4& box =
                abi::is_leaf(child) ? leaf_boxes[child & ~abi::leaf_bit] : boxes[child];
            set_box(node, slot, box);
            boxes[i].include(box);
        }
    }
}

double surface_area_cost(const Bvh& bvh)
{
    double areas = 0.0;
    Box4 root;
    for (std::size_t i = 0; i < bvh.nodes.size(); ++i)
        for (std::size_t slot = 0; slot < abi::node_width; ++slot) {
            if (!is_present(bvh.nodes[i], slot))
                continue;
            const Box4 box = box_in(bvh.nodes[i], slot);
            areas += double{half_area(box)};
            if (i == 0)
                root.include(box);
        }
    return areas > 0.0 ? areas / double{half_area(root)} : 0.0;
}

}  // namespace packtrace
