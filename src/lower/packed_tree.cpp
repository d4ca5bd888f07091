#include "lower/packed_tree.hpp"

#include "bvh/bvh.hpp"
#include "core/in_parallel.hpp"
#include "lower/tree_objects.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace packtrace {
namespace {

enum ItemKind : std::uint32_t { sphere_item, quadric_item, polygon_item };
constexpr std::size_t item_kinds = 3;

/// How far single precision may shift a hit of a sphere, as a share of all distances:
/// docs/numerics_derivations.md derives 16 units in the last place.
constexpr double sphere_slack = 2e-6;

/// Boxes get room for rounding a centre and a radius to single precision: shares of both, each of
/// at least five unit roundoffs.
constexpr double half_slack = 1e-6;
constexpr double center_slack = 3e-7;

/// The ball around the BVH is larger by this factor than computed, for rounding.
constexpr double root_ball_room = 1.000001;

/// Rays of a cell whose directions differ by more than this share of a leaf's mean size over the
/// BVH's extent go into lists (coherent_spread_with_lists in results/tree_designs.json).
constexpr double spread_factor = 0.5;

/// The spread stays between these. At 0.3 all scenes were slower than at 0.1 (coherent_spread in
/// results/tree_designs.json).
constexpr double least_spread = 0.002;
constexpr double largest_spread = 0.1;

float round_down(double x)
{
    const auto rounded = static_cast<float>(x);
    return std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

float round_up(double x)
{
    const auto rounded = static_cast<float>(x);
    return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

/// Half the sizes of a box, with room for rounding.
Vec3 with_slack(const CenteredBox& box)
{
    return box.half * (1.0 + half_slack) + glm::abs(box.center) * center_slack;
}

BvhItem make_item(const CenteredBox& box, std::size_t number, ItemKind kind)
{
    BvhItem item{};
    const Vec3 size = with_slack(box);
    for (int axis = 0; axis < 3; ++axis) {
        item.low[axis] = round_down(box.center[axis] - size[axis]);
        item.high[axis] = round_up(box.center[axis] + size[axis]);
    }
    item.number = static_cast<std::uint32_t>(number);
    item.kind = kind;
    return item;
}

template <class Object>
constexpr ItemKind item_kind = Object::kind == abi::SurfaceKind::sphere    ? sphere_item
                               : Object::kind == abi::SurfaceKind::polygon ? polygon_item
                                                                           : quadric_item;

/// Writes the items of the objects that are in the BVH, in order; returns their end.
template <class Object>
BvhItem* fill_items(const LoweredScene& lowered, const std::vector<Object>& objects, BvhItem* items)
{
    for_each_in_parallel(objects, [&](const Object& object) {
        const auto number = static_cast<std::size_t>(&object - objects.data());
        items[number] = make_item(box_of(object), number, item_kind<Object>);
    });
    return std::remove_if(items, items + objects.size(), [&](const BvhItem& item) {
        return !is_in_bvh(lowered, objects[item.number]);
    });
}

Bvh build_bvh_of(const LoweredScene& lowered)
{
    const auto items = AlignedArray<BvhItem>::unset(
        lowered.spheres.size() + lowered.quadrics.size() + lowered.polygons.size());
    BvhItem* end = fill_items(lowered, lowered.spheres, items.data());
    end = fill_items(lowered, lowered.quadrics, end);
    end = fill_items(lowered, lowered.polygons, end);
    return build_bvh({items.data(), end});
}

float extent_of(const abi::BvhNode& root)
{
    float extent = 0.0f;
    for (int slot = 0; slot < abi::node_width; ++slot)
        for (int axis = 0; axis < 3; ++axis)
            if (root.low[axis][slot] <= root.high[axis][slot])
                extent = std::max({extent, -root.low[axis][slot], root.high[axis][slot]});
    return extent;
}

/// BvhView::spread, from the mean size of a leaf over the BVH's extent.
float coherent_spread(const std::vector<abi::BvhNode>& nodes, float extent)
{
    double sizes = 0.0;
    double leaves = 0.0;
    for (const abi::BvhNode& node : nodes)
        for (int slot = 0; slot < abi::node_width; ++slot) {
            if (!abi::is_leaf(node.child[slot]) || node.low[0][slot] > node.high[0][slot])
                continue;
            Vec3 size;
            for (int axis = 0; axis < 3; ++axis)
                size[axis] = double{node.high[axis][slot]} - double{node.low[axis][slot]};
            sizes += glm::length(size);
            leaves += 1.0;
        }
    return static_cast<float>(
        std::clamp(spread_factor * sizes / (leaves * extent), least_spread, largest_spread));
}

double worst_slack(const LoweredScene& lowered)
{
    double condition = 1.0;
    for (const LoweredQuadric& quadric : lowered.quadrics)
        if (is_in_bvh(lowered, quadric))
            condition = std::max(condition, quadric.condition);
    return sphere_slack * condition;
}

/// How many records all leaves need, by kind: a block for up to eight spheres, a record for each
/// other object.
using LeafCounts = std::array<std::uint32_t, item_kinds>;

std::uint32_t records_of(const BvhLeaf& leaf)
{
    return leaf.kind == sphere_item ? 1 : leaf.count;
}

LeafCounts count_records(const Bvh& bvh)
{
    LeafCounts count{};
    for (const BvhLeaf& leaf : bvh.leaves)
        count[leaf.kind] += records_of(leaf);
    return count;
}

/// The names by which nodes refer to leaves. Records of runs share one numbering, quadrics first.
std::vector<std::uint32_t> leaf_names(const Bvh& bvh, const LeafCounts& count)
{
    LeafCounts next{};
    next[polygon_item] = count[quadric_item];
    std::vector<std::uint32_t> names;
    names.reserve(bvh.leaves.size());
    for (const BvhLeaf& leaf : bvh.leaves) {
        std::uint32_t name = abi::leaf_bit | next[leaf.kind];
        if (leaf.kind != sphere_item)
            name |= abi::run_bit | (leaf.count - 1) << abi::run_count_shift;
        names.push_back(name);
        next[leaf.kind] += records_of(leaf);
    }
    return names;
}

/// The polygons of runs, in the order of their records.
std::vector<const LoweredPolygon*> polygons_of_runs(const LoweredScene& lowered, const Bvh& bvh)
{
    std::vector<const LoweredPolygon*> polygons;
    for (const BvhLeaf& leaf : bvh.leaves)
        if (leaf.kind == polygon_item)
            for (std::uint32_t i = 0; i < leaf.count; ++i)
                polygons.push_back(&lowered.polygons[bvh.order[leaf.first + i]]);
    return polygons;
}

/// The name of an absent child: that of an existing leaf, because rays from infinitely far away hit
/// every box.
std::uint32_t absent_name(const LeafCounts& count)
{
    return count[sphere_item] > 0 ? abi::leaf_bit : abi::leaf_bit | abi::run_bit;
}

void name_leaves(std::span<abi::BvhNode> nodes, const std::vector<std::uint32_t>& names,
                 std::uint32_t absent)
{
    for (abi::BvhNode& node : nodes)
        for (int slot = 0; slot < abi::node_width; ++slot) {
            if (!abi::is_leaf(node.child[slot]))
                continue;
            const bool is_there = node.low[0][slot] <= node.high[0][slot];
            node.child[slot] = is_there ? names[node.child[slot] & ~abi::leaf_bit] : absent;
        }
}

/// The largest distance by which rounding to Real moves a sphere's centre.
template <class Real>
float worst_center_error(const std::vector<LoweredSphere>& spheres)
{
    // Enough work for a task to be worth its start.
    constexpr std::size_t task_spheres = 4096;
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, spheres.size(), task_spheres), 0.0f,
        [&](const tbb::blocked_range<std::size_t>& part, float worst) {
            for (std::size_t i = part.begin(); i < part.end(); ++i)
                worst = std::max(worst, round_up(center_error<Real>(spheres[i])));
            return worst;
        },
        [](float a, float b) { return std::max(a, b); });
}

/// The box of a leaf's objects, computed in double and rounded once.
template <class Object>
Box4 box_of_leaf(const std::vector<Object>& objects, const Bvh& bvh, const BvhLeaf& leaf)
{
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high(-std::numeric_limits<double>::infinity());
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
        const CenteredBox box = box_of(objects[bvh.order[leaf.first + i]]);
        const Vec3 size = with_slack(box);
        low = glm::min(low, box.center - size);
        high = glm::max(high, box.center + size);
    }
    Box4 rounded;
    for (int axis = 0; axis < 3; ++axis) {
        rounded.low[axis] = round_down(low[axis]);
        rounded.high[axis] = round_up(high[axis]);
    }
    return rounded;
}

}  // namespace

void refit_tree(const LoweredScene& lowered, Bvh& bvh)
{
    std::vector<Box4> boxes(bvh.leaves.size());
    for_each_in_parallel(bvh.leaves, [&](const BvhLeaf& leaf) {
        Box4& box = boxes[static_cast<std::size_t>(&leaf - bvh.leaves.data())];
        if (leaf.kind == sphere_item)
            box = box_of_leaf(lowered.spheres, bvh, leaf);
        else if (leaf.kind == quadric_item)
            box = box_of_leaf(lowered.quadrics, bvh, leaf);
        else
            box = box_of_leaf(lowered.polygons, bvh, leaf);
    });
    refit_bvh(bvh, boxes);
}

template <class Real>
PackedTree<Real>::PackedTree(const LoweredScene& lowered, Bvh* keep)
{
    Bvh bvh = build_bvh_of(lowered);
    if (bvh.nodes.empty())
        return;
    const LeafCounts count = count_records(bvh);
    nodes_ = AlignedArray<abi::BvhNode>::unset(bvh.nodes.size());
    blocks_ = AlignedArray<abi::SphereBlock<Real>>::unset(count[sphere_item]);
    block_surfaces_ =
        AlignedArray<std::int32_t>::unset(std::size_t{count[sphere_item]} * abi::node_width);
    quadrics_ = AlignedArray<abi::QuadricRecord<Real>>::unset(count[quadric_item]);
    polygons_ = AlignedArray<abi::PolygonRecord<Real>>::unset(count[polygon_item]);
    run_surfaces_ =
        AlignedArray<std::int32_t>::unset(std::size_t{count[quadric_item]} + count[polygon_item]);
    view_.nodes = nodes_.data();
    view_.blocks = blocks_.data();
    view_.block_surfaces = block_surfaces_.data();
    view_.run_surfaces = run_surfaces_.data();
    view_.quadrics = quadrics_.data();
    view_.polygons = polygons_.data();
    view_.quadric_count = static_cast<int>(quadrics_.size());
    view_.node_count = static_cast<int>(bvh.nodes.size());
    refit(lowered, bvh);
    if (keep != nullptr)
        *keep = std::move(bvh);
}

/// Fills in all but the sizes and pointers, which depend on the numbers of objects and nodes alone.
template <class Real>
void PackedTree<Real>::refit(const LoweredScene& lowered, const Bvh& bvh)
{
    std::copy(bvh.nodes.begin(), bvh.nodes.end(), nodes_.data());
    pack_leaves(lowered, bvh);
    view_.extent = extent_of(nodes_[0]);
    view_.slack = static_cast<float>(worst_slack(lowered));
    view_.spread = coherent_spread(bvh.nodes, view_.extent);
    bound_root(nodes_[0]);
    view_.center_error = worst_center_error<Real>(lowered.spheres);
}

/// The ball around the root's box.
template <class Real>
void PackedTree<Real>::bound_root(const abi::BvhNode& root)
{
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high(-std::numeric_limits<double>::infinity());
    for (int slot = 0; slot < abi::node_width; ++slot)
        for (int axis = 0; axis < 3; ++axis)
            if (root.low[axis][slot] <= root.high[axis][slot]) {
                low[axis] = std::min(low[axis], double{root.low[axis][slot]});
                high[axis] = std::max(high[axis], double{root.high[axis][slot]});
            }
    Vec3 rounded;
    for (int axis = 0; axis < 3; ++axis) {
        view_.middle[axis] = static_cast<float>(0.5 * low[axis] + 0.5 * high[axis]);
        rounded[axis] = double{view_.middle[axis]};
    }
    view_.radius = round_up(root_ball_room *
                            std::max(glm::length(high - rounded), glm::length(low - rounded)));
}

template <class Real>
abi::BvhView<double> PackedTree<Real>::wide_view(const abi::ShapesView& shapes) const
{
    return {.nodes = view_.nodes,
            .block_surfaces = view_.block_surfaces,
            .run_surfaces = view_.run_surfaces,
            .quadric_count = view_.quadric_count,
            .shapes = &shapes,
            .node_count = view_.node_count,
            .extent = view_.extent,
            .slack = view_.slack,
            .spread = view_.spread};
}

/// Packs the leaves' objects, and puts the leaves' names into the nodes.
template <class Real>
void PackedTree<Real>::pack_leaves(const LoweredScene& lowered, const Bvh& bvh)
{
    const LeafCounts count = count_records(bvh);
    const std::vector<std::uint32_t> names = leaf_names(bvh, count);
    for_each_in_parallel(bvh.leaves, [&](const BvhLeaf& leaf) {
        const std::uint32_t name = names[static_cast<std::size_t>(&leaf - bvh.leaves.data())];
        if (leaf.kind == sphere_item)
            pack_block(lowered, bvh, leaf, name & abi::block_mask);
        else if (leaf.kind == quadric_item)
            pack_run(lowered.quadrics, bvh, leaf, name & abi::run_mask, 0, quadrics_);
        else
            pack_run(lowered.polygons, bvh, leaf, name & abi::run_mask, count[quadric_item],
                     polygons_);
    });
    polygon_corners_ =
        PackedCorners<Real>(polygons_of_runs(lowered, bvh), {polygons_.data(), polygons_.size()});
    name_leaves({nodes_.data(), nodes_.size()}, names, absent_name(count));
}

/// `first` is the number of the run's first record, `base` that of the first one in `records`.
template <class Real>
template <class Object, class Record>
void PackedTree<Real>::pack_run(const std::vector<Object>& objects, const Bvh& bvh,
                                const BvhLeaf& leaf, std::size_t first, std::size_t base,
                                AlignedArray<Record>& records)
{
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
        const Object& object = objects[bvh.order[leaf.first + i]];
        records[first - base + i] = pack<Real>(object);
        run_surfaces_[first + i] = object.surface;
    }
}

template <class Real>
void PackedTree<Real>::pack_block(const LoweredScene& lowered, const Bvh& bvh, const BvhLeaf& leaf,
                                  std::uint32_t index)
{
    abi::SphereBlock<Real>& block = blocks_[index];
    std::int32_t* const surfaces = &block_surfaces_[std::size_t{index} * abi::node_width];
    // Unused slots hold spheres of negative radius, at the largest coordinate of objects in a BVH.
    constexpr Real nowhere = Real(1e15);
    for (std::uint32_t i = 0; i < abi::node_width; ++i) {
        const bool used = i < leaf.count;
        const LoweredSphere unused;
        const LoweredSphere& sphere = used ? lowered.spheres[bvh.order[leaf.first + i]] : unused;
        for (int axis = 0; axis < 3; ++axis)
            block.center[axis][i] = used ? static_cast<Real>(sphere.center[axis]) : nowhere;
        block.radius[i] = used ? static_cast<Real>(sphere.radius) : Real(-1);
        surfaces[i] = used ? sphere.surface : -1;
    }
}

template class PackedTree<float>;
template class PackedTree<double>;

}  // namespace packtrace
