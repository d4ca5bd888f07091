#include "lab/harness/ray_trees.hpp"

#include <algorithm>
#include <memory>

#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "lab/harness/packet_tree.hpp"
#include "lower/packed_scene.hpp"
#include "reference/reference.hpp"
#include "reference/tree_recorder.hpp"
#include "render/camera_view.hpp"

namespace packtrace {
namespace {

// Column and row in turns, from the lowest bit.
int z_order(int column, int row)
{
    int number = 0;
    for (int bit = 0; (1 << bit) < abi::tile_size; ++bit)
        number |= (((column >> bit) & 1) | (((row >> bit) & 1) << 1)) << (2 * bit);
    return number;
}

template <class Real>
class PacketTrees {
public:
    PacketTrees(const Scene& scene, const LoweredScene& lowered, const abi::KernelTable& table)
        : scene_(scene),
          packed_(lowered),
          camera_(camera_view<Real>(scene, lowered)),
          kernels_(kernels_for(
              precision<Real>(table),
              {.quadrics = true, .glass = true, .probe = true, .exact = lowered.features.exact})),
          scratch_(kernels_.scratch_bytes(packed_.view(), 1))
    {
    }

    // The pixel's whole tile is rendered, in the packets it always shares with its neighbours.
    [[nodiscard]] RayNode tree(int x, int y)
    {
        PacketTree<Real> tree(scene_);
        const int column = x % abi::tile_size;
        const int row = y % abi::tile_size;
        const abi::Probe<Real> probe = tree.probe(z_order(column, row));
        Real rgb[3 * abi::tile_pixels];

        abi::TileJob<Real> job;
        job.scene = &packed_.view();
        job.camera = &camera_;
        job.x = x - column;
        job.y = y - row;
        job.width = std::min(abi::tile_size, scene_.width - job.x);
        job.height = std::min(abi::tile_size, scene_.height - job.y);
        job.rgb = rgb;
        job.row_stride = 3 * abi::tile_size;
        job.scratch = scratch_.data();
        job.probe = &probe;
        (void)kernels_.render_tiles(&job, 1);
        return tree.root();
    }

private:
    Scene scene_;
    PackedScene<Real> packed_;
    abi::CameraView<Real> camera_;
    const abi::FeatureKernels<Real>& kernels_;
    AlignedArray<std::byte> scratch_;
};

// The reference and the tree it grows.
template <class Real>
struct ReferenceTrees {
    reference::TreeRecorder::Growth growth;
    reference::Reference<Real, reference::TreeRecorder> reference;

    explicit ReferenceTrees(const Scene& scene, SelfHits self_hits = default_self_hits)
        : reference(scene, reference::TreeRecorder(growth), self_hits)
    {
    }
    template <class Trace>
    [[nodiscard]] RayNode grow(const Trace& trace)
    {
        growth.root = {};
        (void)trace(reference);
        return std::move(growth.root);
    }
};

}  // namespace

template <class Real>
TreeOfPixel packet_trees(const Scene& scene, const LoweredScene& lowered,
                         const abi::KernelTable& table)
{
    const auto trees = std::make_shared<PacketTrees<Real>>(scene, lowered, table);
    return [trees](int x, int y) { return trees->tree(x, y); };
}

template <class Real>
TreeOfPixel reference_trees(const Scene& scene, SelfHits self_hits)
{
    const auto trees = std::make_shared<ReferenceTrees<Real>>(scene, self_hits);
    return [trees](int x, int y) {
        return trees->grow([&](const auto& reference) { return reference.trace_pixel(x, y); });
    };
}

TreesOfPixel reference_sample_trees(const Scene& scene, const std::vector<Vec2>& places)
{
    const auto trees = std::make_shared<ReferenceTrees<double>>(scene);
    return [trees, places](int x, int y) {
        std::vector<RayNode> grown;
        for (const Vec2& place : places)
            grown.push_back(trees->grow(
                [&](const auto& reference) { return reference.trace_samples(x, y, {place}); }));
        return grown;
    };
}

template TreeOfPixel packet_trees<float>(const Scene&, const LoweredScene&,
                                         const abi::KernelTable&);
template TreeOfPixel packet_trees<double>(const Scene&, const LoweredScene&,
                                          const abi::KernelTable&);
template TreeOfPixel reference_trees<float>(const Scene&, SelfHits);
template TreeOfPixel reference_trees<double>(const Scene&, SelfHits);

}  // namespace packtrace
