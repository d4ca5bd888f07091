#include "bvh/bvh.hpp"
#include "bvh/split.hpp"
#include "catch.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <random>

// Invariants of the bvh for all kinds of input.
namespace packtrace {
namespace {

struct Items {
    const char* name;
    std::vector<BvhItem> items;
};

BvhItem item_at(float x, float y, float z, float size, std::uint32_t number, std::uint32_t kind = 0)
{
    return {{x - size, y - size, z - size}, number, {x + size, y + size, z + size}, kind};
}

std::vector<BvhItem> scattered(int count, std::uint32_t kinds)
{
    std::mt19937 random(static_cast<unsigned>(count));
    std::uniform_real_distribution<float> place(-10.0f, 10.0f);
    std::vector<BvhItem> items;
    for (int i = 0; i < count; ++i) {
        const float x = place(random);
        const float y = place(random);
        const float z = place(random);
        const auto number = static_cast<std::uint32_t>(i);
        items.push_back(item_at(x, y, z, 0.01f * std::abs(place(random)), number, number % kinds));
    }
    return items;
}

std::vector<BvhItem> along_a_line(int count, float ratio)
{
    std::vector<BvhItem> items;
    float x = 1.0f;
    for (int i = 0; i < count; ++i, x *= ratio)
        items.push_back(item_at(x, 0.0f, 0.0f, 0.1f * x, static_cast<std::uint32_t>(i)));
    return items;
}

/// Every other item is far away along one of the axes, on either side, with faces at `low` and
/// `high`.
std::vector<BvhItem> far_apart(float low, float high)
{
    std::vector<BvhItem> items = scattered(100, 1);
    for (std::size_t i = 0; i < items.size(); i += 2) {
        const std::size_t axis = i / 2 % 3;
        const bool mirrored = i % 4 == 0;
        items[i].low[axis] = mirrored ? -high : low;
        items[i].high[axis] = mirrored ? -low : high;
    }
    return items;
}

std::vector<BvhItem> closest_together()
{
    std::vector<BvhItem> items;
    for (std::uint32_t i = 0; i < 100; ++i)
        items.push_back(item_at(static_cast<float>(i) * 1e-42f, 0.0f, 0.0f, 0.0f, i));
    return items;
}

std::vector<Items> families()
{
    constexpr float largest = std::numeric_limits<float>::max();
    constexpr float inf = std::numeric_limits<float>::infinity();
    return {{"one item", scattered(1, 1)},
            {"eight items", scattered(8, 1)},
            {"nine items", scattered(9, 1)},
            {"a few of two kinds", scattered(7, 2)},
            {"a thousand of three kinds", scattered(1000, 3)},
            {"a hundred thousand", scattered(100000, 1)},
            {"all in one place", along_a_line(500, 1.0f)},
            {"ever smaller", along_a_line(150, 0.6f)},
            {"areas that overflow", far_apart(1e25f, 1.1e25f)},
            {"sums of corners that overflow", far_apart(1.75e38f, 1.76e38f)},
            {"as far as floats go", far_apart(largest, inf)},
            {"at infinity", far_apart(inf, inf)},
            {"without bounds", far_apart(-inf, inf)},
            {"closer together than numbers with all digits", closest_together()},
            {"flat", std::vector<BvhItem>(300, item_at(2.0f, 2.0f, 2.0f, 0.0f, 0))}};
}

/// Traverses a bvh and counts its faults.
class Validator {
public:
    Validator(const Bvh& bvh, const std::vector<BvhItem>& items)
        : bvh_(bvh), items_(items), seen_(bvh.leaves.size(), 0)
    {
        visit(0, 1);
        for (const int times : seen_)
            faults += times == 1 ? 0 : 1;
    }

    int faults = 0;
    int levels = 0;

private:
    void visit(std::uint32_t index, int level)
    {
        levels = std::max(levels, level);
        const abi::BvhNode& node = bvh_.nodes.at(index);
        for (int slot = 0; slot < abi::node_width; ++slot) {
            if (node.low[0][slot] > node.high[0][slot])
                continue;
            const std::uint32_t child = node.child[slot];
            if (abi::is_leaf(child)) {
                check_leaf(node, slot, child & ~abi::leaf_bit);
            } else {
                check_inside(node, slot, bvh_.nodes.at(child));
                visit(child, level + 1);
            }
        }
    }

    void check_leaf(const abi::BvhNode& node, int slot, std::uint32_t number)
    {
        const BvhLeaf& leaf = bvh_.leaves.at(number);
        ++seen_[number];
        faults += leaf.count < 1 || leaf.count > abi::node_width ? 1 : 0;
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const BvhItem& item = items_.at(bvh_.order.at(leaf.first + i));
            faults += item.kind == leaf.kind ? 0 : 1;
            for (int axis = 0; axis < 3; ++axis)
                faults += node.low[axis][slot] <= item.low[axis] &&
                                  item.high[axis] <= node.high[axis][slot]
                              ? 0
                              : 1;
        }
    }

    void check_inside(const abi::BvhNode& node, int slot, const abi::BvhNode& child)
    {
        for (int inner = 0; inner < abi::node_width; ++inner)
            for (int axis = 0; axis < 3; ++axis)
                if (child.low[axis][inner] <= child.high[axis][inner])
                    faults += node.low[axis][slot] <= child.low[axis][inner] &&
                                      child.high[axis][inner] <= node.high[axis][slot]
                                  ? 0
                                  : 1;
    }

    const Bvh& bvh_;
    const std::vector<BvhItem>& items_;
    std::vector<int> seen_;
};

}  // namespace

TEST_CASE("a bvh holds every item once, in boxes inside boxes", "[bvh]")
{
    for (const Items& family : families()) {
        INFO(family.name);
        std::vector<BvhItem> items = family.items;
        for (std::size_t i = 0; i < items.size(); ++i)
            items[i].number = static_cast<std::uint32_t>(i);
        const std::vector<BvhItem> as_given = items;
        const Bvh bvh = build_bvh(items);
        std::vector<int> times(items.size(), 0);
        for (const std::uint32_t number : bvh.order)
            ++times.at(number);
        CHECK(times == std::vector<int>(items.size(), 1));
        const Validator validator(bvh, as_given);
        CHECK(validator.faults == 0);
        CHECK(validator.levels <= abi::bvh_levels);
    }
}

TEST_CASE("a face at NaN counts as a face at infinity", "[bvh]")
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float inf = std::numeric_limits<float>::infinity();
    std::vector<BvhItem> items = scattered(100, 1);
    std::vector<BvhItem> unbounded = items;
    for (std::size_t i = 0; i < items.size(); i += 9)
        for (int axis = 0; axis < 3; ++axis) {
            items[i].low[axis] = nan;
            items[i].high[axis] = nan;
            unbounded[i].low[axis] = -inf;
            unbounded[i].high[axis] = inf;
        }
    const Bvh bvh = build_bvh(items);
    CHECK(Validator(bvh, unbounded).faults == 0);
}

TEST_CASE("a bvh without items has no nodes", "[bvh]")
{
    CHECK(build_bvh({}).nodes.empty());
}

TEST_CASE("the validator detects a box that is too small", "[bvh]")
{
    std::vector<BvhItem> items = scattered(100, 1);
    const std::vector<BvhItem> as_given = items;
    Bvh bvh = build_bvh(items);
    bvh.nodes[0].high[1][0] -= 1.0f;
    CHECK(Validator(bvh, as_given).faults > 0);
}

namespace {

std::vector<Box4> boxes_of_leaves(const Bvh& bvh, const std::vector<BvhItem>& items)
{
    std::vector<Box4> boxes;
    for (const BvhLeaf& leaf : bvh.leaves) {
        Box4 box;
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const BvhItem& item = items.at(bvh.order.at(leaf.first + i));
            box.include(low_of(item), high_of(item));
        }
        boxes.push_back(box);
    }
    return boxes;
}

}  // namespace

TEST_CASE("a refitted bvh holds every item where it is now", "[bvh]")
{
    for (const Items& family : families()) {
        CAPTURE(family.name);
        std::vector<BvhItem> sorted = family.items;
        Bvh bvh = build_bvh(sorted);
        // If no item has moved, refitting changes nothing.
        const std::vector<abi::BvhNode> built = bvh.nodes;
        refit_bvh(bvh, boxes_of_leaves(bvh, family.items));
        CHECK(std::memcmp(built.data(), bvh.nodes.data(), built.size() * sizeof built[0]) == 0);

        std::vector<BvhItem> moved = family.items;
        std::mt19937 random(3);
        std::uniform_real_distribution<float> by(-5.0f, 5.0f);
        for (BvhItem& item : moved)
            for (int axis = 0; axis < 3; ++axis) {
                const float step = by(random);
                item.low[axis] += step;
                item.high[axis] += step;
            }
        refit_bvh(bvh, boxes_of_leaves(bvh, moved));
        CHECK(Validator(bvh, moved).faults == 0);
    }
}

TEST_CASE("the cost of a bvh grows as its items scatter", "[bvh]")
{
    const std::vector<BvhItem> items = scattered(5000, 1);
    std::vector<BvhItem> sorted = items;
    Bvh bvh = build_bvh(sorted);
    const double built = surface_area_cost(bvh);
    CHECK(built > 1.0);
    std::vector<BvhItem> moved = items;
    std::shuffle(moved.begin(), moved.end(), std::mt19937(4));
    refit_bvh(bvh, boxes_of_leaves(bvh, moved));
    CHECK(surface_area_cost(bvh) > 5.0 * built);
}

TEST_CASE("a bvh does not depend on the number of threads", "[bvh][bulk]")
{
    const auto built_with = [](int threads) {
        std::vector<BvhItem> items = scattered(100000, 1);
        return tbb::task_arena(threads).execute([&] { return build_bvh(items); });
    };
    const Bvh one = built_with(1);
    const Bvh two = built_with(2);
    CHECK(one.order == two.order);
    REQUIRE(one.nodes.size() == two.nodes.size());
    // Compares each field: the padding of a node may hold anything.
    const auto same = [](const abi::BvhNode& a, const abi::BvhNode& b) {
        return std::memcmp(a.low, b.low, sizeof a.low) == 0 &&
               std::memcmp(a.high, b.high, sizeof a.high) == 0 &&
               std::memcmp(a.child, b.child, sizeof a.child) == 0;
    };
    CHECK(std::equal(one.nodes.begin(), one.nodes.end(), two.nodes.begin(), same));
}

}  // namespace packtrace
