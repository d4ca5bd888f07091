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

/// What one light does at a point.
struct LightShare {
    int light = -1;  ///< index in Scene::lights, never an ambient one
    /// What shadows let through, per channel in [0, 1]. Packets send no shadow ray, and know
    /// nothing here, where the light is behind the surface and gives no highlight either.
    std::optional<Rgb> share;
    /// What it adds to the local light, before RayNode::weight and the part that `scratch`
    /// takes off a mirror's own light.
    Rgb color{0.0};
};

/// A ray, what it hit, and the rays that went on from there. The pixel's colour is the sum of
/// weight * (local + brought) over all rays of its tree.
struct RayNode {
    RayKind kind = RayKind::camera;
    Vec3 org{0.0};
    Vec3 dir{0.0};    ///< unit but in `scratch`, where it is as long as the canvas has it
    Rgb weight{1.0};  ///< the ray's part in the pixel
    /// Of the closest hit, in lengths of `dir`; infinite for a ray that hits nothing.
    double t = std::numeric_limits<double>::infinity();
    int object = -1;                 ///< index in Scene::objects; -1 for none
    Vec3 point{0.0};                 ///< of the hit
    Vec3 normal{0.0};                ///< unit, on the side that is shaded
    std::vector<LightShare> lights;  ///< by rising index, ambient ones left out
    Rgb local{0.0};                  ///< what the surface itself sends back along the ray
    /// Light without a ray of its own: what a ray that hits nothing sees, or what the depth limit
    /// gives in place of children.
    Rgb brought{0.0};
    std::vector<RayNode> children;  ///< at most one mirrored, then at most one refracted ray
};

/// The ray tree of the pixel in column `x` and row `y`, as the packets of `Real` (float or
/// double) trace it, or with the scalar kernel the reference, which comes in double only. Of the
/// options `kernel`, `isa`, `width`, `accuracy` and `self_hits` count. Packets are those of
/// render(), with all features compiled in and reports of this one pixel's rays added. Throws
/// std::invalid_argument for a pixel outside the picture, impossible options, and a
/// Scene::max_depth that packets cannot number (over 28 in float, 60 in double); else as render()
/// does.
template <class Real>
[[nodiscard]] PACKTRACE_API RayNode explain_pixel(const Scene& scene, int x, int y,
                                                  const RenderOptions& options = {});

/// The colour of the pixel: weight * (local + brought), summed over the tree.
[[nodiscard]] PACKTRACE_API Rgb sum_of(const RayNode& tree);

/// One quantity of one ray in two trees.
struct TreeRow {
    std::string ray;    ///< "camera", "camera, mirrored", "camera, mirrored, refracted" …
    int depth = 0;      ///< generation of the ray
    std::string field;  ///< "origin", "t", "object" (its index), "light 2 share" (counted from 1) …
    /// One or three numbers; none where this tree does not know the quantity.
    std::vector<double> first, second;
    bool differs = false;
};

/// Relative tolerances for trees of the two precisions against the reference.
inline constexpr double single_tree_tolerance = 1e-4;
inline constexpr double double_tree_tolerance = 1e-9;

/// Two trees of one pixel, quantity by quantity, ray by ray, each ray before its children. Numbers
/// differ where they are further apart than `tolerance` times the larger of 1 and the values'
/// lengths; another object, and a ray that only one tree has, always differ.
[[nodiscard]] PACKTRACE_API std::vector<TreeRow> side_by_side(const RayNode& first,
                                                              const RayNode& second,
                                                              double tolerance);

}  // namespace packtrace
