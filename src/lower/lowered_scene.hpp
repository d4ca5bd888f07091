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

/// Coefficients of the one shading equation (abi::MaterialRecord).
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

/// A scene brought down to what the kernels know: surfaces by kind, one equation of shading,
/// world space, double precision.
struct LoweredScene : SurfaceLists {
    std::vector<abi::MaterialIndex> material_index;  ///< by surface
    std::vector<std::uint8_t> faces_viewer;          ///< by surface: normals turn to the ray
    std::vector<bool> casts_shadow;                  ///< by surface; none: all do
    std::vector<LoweredMaterial> materials;          ///< may be shared by objects
    std::vector<LoweredChecker> checkers;
    std::vector<Light> lights;  ///< none ambient
    Rgb background{0.0};
    Rgb limit_color{0.0};  ///< what rays beyond the depth limit bring
    int max_depth = 0;
    double min_weight = 0.0;  ///< least_traced_weight()
    bool shadows = true;
    bool flat = false;  ///< see prune()
    bool transparent_shadows = false;
    bool visible_lights = false;
    abi::RayUnits units = abi::RayUnits::as_given;
    bool highlights_behind = false;  ///< lights behind a surface make highlights on it too
    double epsilon = 0.0;            ///< start of secondary and shadow rays with SelfHits::note
    SelfHits self_hits = SelfHits::note;
    double camera_t_min = 0.0;  ///< start of camera rays
    /// Objects that reach further are in no hierarchy (tree_objects.hpp).
    double tree_reach = std::numeric_limits<double>::infinity();
    std::vector<std::int32_t> eye_inside;  ///< glass objects around the eye, innermost first
    abi::Features features;                ///< `exact` as the accuracy asked for has it
    bool highlights = false;               ///< of some material
    bool bounces = false;                  ///< mirrored rays, or refracted ones
};

/// Lowers a scene on the threads of the TBB arena the call runs in; the result does not depend on
/// their number. Throws as validate() does.
[[nodiscard]] LoweredScene lower(const Scene& scene, Accuracy accuracy = Accuracy::exact,
                                 SelfHits self_hits = default_self_hits);

/// The most light that a ray can bring in each channel, by its generation from 0 (camera rays) to
/// max_depth. docs/numerics_derivations.md derives it.
[[nodiscard]] std::vector<Rgb> most_light(const LoweredScene& lowered);

/// The accuracy that counts for kernels of `Real`: doubles need nothing wider.
template <class Real>
[[nodiscard]] Accuracy accuracy_in(const RenderOptions& options)
{
    return sizeof(Real) == sizeof(float) ? options.accuracy : Accuracy::fast;
}

/// Lowers a scene for kernels of `Real` as options of rendering have it.
template <class Real>
[[nodiscard]] LoweredScene lower_for(const Scene& scene, const RenderOptions& options)
{
    return lower(scene, accuracy_in<Real>(options), options.self_hits);
}

}  // namespace packtrace
