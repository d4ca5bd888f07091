#include "lab/harness/packet_tree.hpp"

#include <bit>
#include <cstdint>

namespace packtrace {
namespace {

template <class Real>
Vec3 vec3(const Real (&v)[3])
{
    return {v[0], v[1], v[2]};
}

// The child of that kind, which comes into being where there is none.
RayNode& child_of(RayNode& parent, RayKind kind)
{
    for (RayNode& child : parent.children)
        if (child.kind == kind)
            return child;
    RayNode& child = parent.children.emplace_back();
    child.kind = kind;
    return child;
}

}  // namespace

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
    abi::Probe<Real> probe;
    probe.pixel = pixel;
    probe.context = this;
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

// Down from the root, by the bits below the leading one.
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

template class PacketTree<float>;
template class PacketTree<double>;

}  // namespace packtrace
