#pragma once

#include <packtrace/export.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace packtrace {

enum class RayKind { camera, mirrored, refracted };

/// The contribution of one light at a hit.
struct LightShare {
    int light = -1;  ///< index in Scene::lights, never of an ambient light
    /// The share of the light that occluders let through, per channel in [0, 1]. Not set if packets
    /// traced no shadow ray: the light is behind the surface and gives no highlight.
    std::optional<Rgb> share;
    /// What the light adds to the local light, before the factor RayNode::weight and before
    /// `scratch` reduces the local light of a mirror.
    Rgb color{0.0};
};

/// A ray, its closest hit, and its child rays. The pixel's colour is the sum of
/// weight * (local + brought) over all rays of the tree.
struct RayNode {
    RayKind kind = RayKind::camera;
    Vec3 org{0.0};
    Vec3 dir{0.0};    ///< unit, except in `scratch`, which does not normalise directions
    Rgb weight{1.0};  ///< the factor of the ray's light in the pixel
    /// The closest hit is at org + t * dir; infinite for a miss.
    double t = std::numeric_limits<double>::infinity();
    int object = -1;                 ///< index in Scene::objects; -1 for a miss
    Vec3 point{0.0};                 ///< of the hit
    Vec3 normal{0.0};                ///< unit, on the side that is shaded
    std::vector<LightShare> lights;  ///< in ascending index order, without ambient lights
    Rgb local{0.0};                  ///< light that the surface itself sends back along the ray
    /// Light without a ray: the background for a miss, or what replaces the children at the depth
    /// limit.
    Rgb brought{0.0};
    std::vector<RayNode> children;  ///< at most one mirrored, then at most one refracted ray
};

/// Returns the ray tree of the pixel in column `x` and row `y`. It is traced by packets of `Real`
/// (float or double), or by the scalar kernel, which has double only. Uses the options `kernel`,
/// `isa`, `width`, `accuracy` and `self_hits`. The packets are those of render(), with all features
/// compiled in, and they also record the rays of this one pixel. Throws std::invalid_argument for a
/// pixel outside the picture, for impossible options, and for a Scene::max_depth above 28 (float)
/// or 60 (double) with packets; otherwise as render() does.
template <class Real>
[[nodiscard]] PACKTRACE_API RayNode explain_pixel(const Scene& scene, int x, int y,
                                                  const RenderOptions& options = {});

/// The colour of the pixel: the sum of weight * (local + brought) over the tree.
[[nodiscard]] PACKTRACE_API Rgb sum_of(const RayNode& tree);

/// One quantity of one ray in two trees.
struct TreeRow {
    std::string ray;    ///< "camera", "camera, mirrored", "camera, mirrored, refracted" …
    int depth = 0;      ///< generation of the ray
    std::string field;  ///< "origin", "t", "object" (its index), "light 2 share" (counted from 1) …
    /// One or three numbers; empty if this tree has no value for the quantity.
    std::vector<double> first, second;
    bool differs = false;
};

/// Relative tolerances for a tree in single or double precision against the reference.
inline constexpr double single_tree_tolerance = 1e-4;
inline constexpr double double_tree_tolerance = 1e-9;

/// Compares two trees of one pixel: one row per quantity of a ray, each ray before its children.
/// Values differ if they are further apart than `tolerance` times the larger of 1 and the values'
/// lengths. Different objects always differ, and so does a ray that only one tree has.
[[nodiscard]] PACKTRACE_API std::vector<TreeRow> side_by_side(const RayNode& first,
                                                              const RayNode& second,
                                                              double tolerance);

}  // namespace packtrace
