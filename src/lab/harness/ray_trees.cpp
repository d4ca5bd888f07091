#include "lab/harness/ray_trees.hpp"

#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "kernel_abi/probe.hpp"
#include "lower/packed_scene.hpp"
#include "reference/recorder.hpp"
#include "reference/reference.hpp"
#include "render/camera_view.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>

namespace packtrace {
namespace {

/// `Node` is RayNode or const RayNode.
template <class Node>
Node* find_child(Node& parent, RayKind kind)
{
    for (Node& child : parent.children)
        if (child.kind == kind)
            return &child;
    return nullptr;
}

}  // namespace

const RayNode* child_of(const RayNode* parent, RayKind kind)
{
    return parent != nullptr ? find_child(*parent, kind) : nullptr;
}

const LightShare* light_of(const RayNode* ray, int light)
{
    if (ray != nullptr)
        for (const LightShare& share : ray->lights)
            if (share.light == light)
                return &share;
    return nullptr;
}

namespace {

template <class Real>
Vec3 vec3(const Real (&v)[3])
{
    return {v[0], v[1], v[2]};
}

// The child of a kind; added if there is none.
RayNode& child_of(RayNode& parent, RayKind kind)
{
    if (RayNode* const child = find_child(parent, kind))
        return *child;
    RayNode& child = parent.children.emplace_back();
    child.kind = kind;
    return child;
}

/// Builds a ray tree from the events of packet kernels about one pixel.
template <class Real>
class PacketTree {
public:
    explicit PacketTree(const Scene& scene);
    PacketTree(const PacketTree&) = delete;
    PacketTree& operator=(const PacketTree&) = delete;

    /// A probe that records into this object, which must outlive it.
    [[nodiscard]] abi::Probe<Real> probe(int pixel);

    [[nodiscard]] const RayNode& root() const
    {
        return root_;
    }

private:
    [[nodiscard]] RayNode& at(abi::PathId path);
    void add_ray(const abi::ProbedRay<Real>& ray);
    void add_light(const abi::ProbedLight<Real>& light);
    void add_hit(const abi::ProbedHit<Real>& hit);

    RayNode root_;
    std::vector<int> light_numbers_;  // index in Scene::lights, by the kernels' light number
};

template <class Real>
PacketTree<Real>::PacketTree(const Scene& scene)
{
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (scene.lights[i].type != LightType::ambient)
            light_numbers_.push_back(static_cast<int>(i));
}

template <class Real>
abi::Probe<Real> PacketTree<Real>::probe(int pixel)
{
    abi::Probe<Real> probe{.pixel = pixel, .context = this};
    probe.ray = [](void* tree, const abi::ProbedRay<Real>& ray) {
        static_cast<PacketTree*>(tree)->add_ray(ray);
    };
    probe.light = [](void* tree, const abi::ProbedLight<Real>& light) {
        static_cast<PacketTree*>(tree)->add_light(light);
    };
    probe.hit = [](void* tree, const abi::ProbedHit<Real>& hit) {
        static_cast<PacketTree*>(tree)->add_hit(hit);
    };
    return probe;
}

// The bits of a path below its leading one are the way down from the root.
template <class Real>
RayNode& PacketTree<Real>::at(abi::PathId path)
{
    RayNode* node = &root_;
    const auto generations = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(path))) - 1;
    for (int bit = generations - 1; bit >= 0; --bit)
        node = &child_of(*node, (path >> bit) & 1 ? RayKind::refracted : RayKind::mirrored);
    return *node;
}

template <class Real>
void PacketTree<Real>::add_ray(const abi::ProbedRay<Real>& ray)
{
    RayNode& node = at(ray.path);
    node.org = vec3(ray.org);
    node.dir = vec3(ray.dir);
    node.weight = vec3(ray.weight);
    node.t = ray.t;
    node.object = ray.object;
    node.brought = vec3(ray.seen);
}

template <class Real>
void PacketTree<Real>::add_light(const abi::ProbedLight<Real>& light)
{
    LightShare share{light_numbers_[static_cast<std::size_t>(light.light)], std::nullopt,
                     vec3(light.color)};
    if (light.can_add != 0)
        share.share = vec3(light.share);
    at(light.path).lights.push_back(share);
}

template <class Real>
void PacketTree<Real>::add_hit(const abi::ProbedHit<Real>& hit)
{
    RayNode& node = at(hit.path);
    node.point = vec3(hit.point);
    node.normal = vec3(hit.normal);
    node.local = vec3(hit.local);
    node.brought = vec3(hit.at_limit);
}

// The bits of column and row by turns, from the lowest.
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

    // Renders the pixel's whole tile, so that it shares packets with its neighbours as in a
    // picture.
    [[nodiscard]] RayNode tree(int x, int y)
    {
        PacketTree<Real> tree(scene_);
        const int column = x % abi::tile_size;
        const int row = y % abi::tile_size;
        const abi::Probe<Real> probe = tree.probe(z_order(column, row));
        Real rgb[3 * abi::tile_pixels];

        abi::TileJob<Real> job{
            .scene = &packed_.view(), .camera = &camera_, .x = x - column, .y = y - row};
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

// The reference and the tree that it builds.
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
