#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "lower/lowered_scene.hpp"
#include <packtrace/explain.hpp>

#include <functional>
#include <vector>

namespace packtrace {

/// Gives the ray tree of the pixel in column x and row y of one scene, which is prepared once. For
/// one thread at a time.
using TreeOfPixel = std::function<RayNode(int x, int y)>;

/// Ray trees by packets, of kernels with a probe; `lowered` is the scene that they trace.
template <class Real>
[[nodiscard]] TreeOfPixel packet_trees(const Scene& scene, const LoweredScene& lowered,
                                       const abi::KernelTable& table);

/// Ray trees by the scalar reference in `Real`, float or double.
template <class Real>
[[nodiscard]] TreeOfPixel reference_trees(const Scene& scene,
                                          SelfHits self_hits = default_self_hits);

/// Gives the trees of a pixel's samples at `places`, by the reference in double.
using TreesOfPixel = std::function<std::vector<RayNode>(int x, int y)>;
[[nodiscard]] TreesOfPixel reference_sample_trees(const Scene& scene,
                                                  const std::vector<Vec2>& places);

/// A ray's child of a kind; null if there is none, or if `parent` is null.
[[nodiscard]] const RayNode* child_of(const RayNode* parent, RayKind kind);

/// The share of light number `light` at a ray's hit; null if it is not known, or if `ray` is null.
[[nodiscard]] const LightShare* light_of(const RayNode* ray, int light);

}  // namespace packtrace
