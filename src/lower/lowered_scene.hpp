#pragma once

#include "geometry/kinds.hpp"
#include "kernel_abi/features.hpp"
#include "kernel_abi/scene_view.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace packtrace {

/// Coefficients of the common shading equation (abi::MaterialRecord).
struct LoweredMaterial {
    Rgb ambient{0.0};
    Rgb diffuse{0.0};
    Rgb highlight{0.0};
    Rgb reflect{0.0};
    Rgb local{1.0};
    Rgb transmit{0.0};
    double shininess = 1.0;
    double ior = 1.0;
};

struct LoweredChecker {
    Vec3 point{0.0};
    Vec3 u{0.0};  ///< axis / size of a square
    Vec3 v{0.0};
};

/// A scene in the terms of the kernels: surfaces sorted by kind, one shading equation, world space,
/// double precision.
struct LoweredScene : SurfaceLists {
    std::vector<abi::MaterialIndex> material_index;  ///< by surface
    std::vector<std::uint8_t> faces_viewer;          ///< by surface: normals are turned to the ray
    std::vector<bool> casts_shadow;                  ///< by surface; empty: all do
    std::vector<LoweredMaterial> materials;          ///< may be shared by objects
    std::vector<LoweredChecker> checkers;
    std::vector<Light> lights;  ///< without the ambient ones
    Rgb background{0.0};
    Rgb limit_color{0.0};  ///< colour of rays beyond the depth limit
    int max_depth = 0;
    double min_weight = 0.0;  ///< least_traced_weight()
    bool shadows = true;
    bool flat = false;  ///< see prune()
    bool transparent_shadows = false;
    bool visible_lights = false;
    abi::RayUnits units = abi::RayUnits::as_given;
    bool highlights_behind = false;  ///< lights behind a surface make highlights on it, too
    double epsilon = 0.0;            ///< t_min of secondary and shadow rays with SelfHits::note
    SelfHits self_hits = SelfHits::note;
    double camera_t_min = 0.0;  ///< t_min of camera rays
    /// Objects with a larger coordinate are not in the BVH (tree_objects.hpp).
    double bvh_extent = std::numeric_limits<double>::infinity();
    std::vector<std::int32_t> eye_inside;  ///< glass objects around the eye, innermost first
    abi::Features features;                ///< `exact` follows the accuracy
    bool highlights = false;               ///< some material has one
    bool bounces = false;                  ///< there are mirrored or refracted rays
};

/// Lowers a scene on the threads of the TBB arena of the caller; the result does not depend on
/// their number. Throws as validate() does.
[[nodiscard]] LoweredScene lower(const Scene& scene, Accuracy accuracy = Accuracy::exact,
                                 SelfHits self_hits = default_self_hits);

/// The largest light that a ray can bring in each channel, by generation from 0 (camera rays) to
/// max_depth. docs/numerics_derivations.md derives it.
[[nodiscard]] std::vector<Rgb> most_light(const LoweredScene& lowered);

/// The accuracy of kernels of `Real`: always `fast` in double, because no wider precision decides
/// unsure rays.
template <class Real>
[[nodiscard]] Accuracy accuracy_in(const RenderOptions& options)
{
    return sizeof(Real) == sizeof(float) ? options.accuracy : Accuracy::fast;
}

/// Lowers a scene for kernels of `Real` by the options of rendering.
template <class Real>
[[nodiscard]] LoweredScene lower_for(const Scene& scene, const RenderOptions& options)
{
    return lower(scene, accuracy_in<Real>(options), options.self_hits);
}

}  // namespace packtrace
