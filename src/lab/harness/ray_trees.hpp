#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "lower/lowered_scene.hpp"
#include <packtrace/explain.hpp>

#include <functional>
#include <vector>

namespace packtrace {

/// The ray tree of the pixel in column x and row y of one scene, made ready once to be asked often.
/// Not for several threads at once.
using TreeOfPixel = std::function<RayNode(int x, int y)>;

/// As packets trace it, with kernels that have a probe, of the scene as `lowered` says it.
template <class Real>
[[nodiscard]] TreeOfPixel packet_trees(const Scene& scene, const LoweredScene& lowered,
                                       const abi::KernelTable& table);

/// As the scalar reference traces it in `Real`, float or double.
template <class Real>
[[nodiscard]] TreeOfPixel reference_trees(const Scene& scene,
                                          SelfHits self_hits = default_self_hits);

/// The trees of the pixel's samples at `places`, as the reference traces them in double.
using TreesOfPixel = std::function<std::vector<RayNode>(int x, int y)>;
[[nodiscard]] TreesOfPixel reference_sample_trees(const Scene& scene,
                                                  const std::vector<Vec2>& places);

/// A ray's child of that kind; null where there is none, or no ray.
[[nodiscard]] const RayNode* child_of(const RayNode* parent, RayKind kind);

/// What the light of that number does where a ray hits; null where it is not known, or no ray.
[[nodiscard]] const LightShare* light_of(const RayNode* ray, int light);

}  // namespace packtrace
