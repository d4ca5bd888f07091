#pragma once

#include <packtrace/explain.hpp>

#include "kernel_abi/probe.hpp"

namespace packtrace {

/// A ray tree grown from what the packet kernels report of one pixel.
template <class Real>
class PacketTree {
public:
    /// `scene` is the one that is traced.
    explicit PacketTree(const Scene& scene);
    PacketTree(const PacketTree&) = delete;
    PacketTree& operator=(const PacketTree&) = delete;

    /// Reports come to this object, which must outlive the probe's use.
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
    std::vector<int> light_numbers_;  // in Scene::lights, by the kernels' number
};

}  // namespace packtrace
