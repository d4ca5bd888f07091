#pragma once

#include <cstdint>
#include <vector>

#include <packtrace/scene.hpp>

#include "kernel_abi/shading.hpp"

namespace packtrace {

struct LoweredSphere {
    Vec3 center{0.0};
    double radius = 1.0;
    std::int32_t object = 0;
    /// So large against the scene that kernels use its curvature at `anchor`, the point of its
    /// surface nearest the scene, in place of its centre.
    bool huge = false;
    Vec3 anchor{0.0};
};

struct LoweredPlane {
    Vec3 point{0.0};
    Vec3 normal{0.0, 1.0, 0.0};  ///< unit
    std::int32_t object = 0;
};

/// Coefficients of the one shading equation (abi::MaterialRecord).
struct LoweredMaterial {
    Rgb ambient{0.0};
    Rgb diffuse{0.0};
    Rgb highlight{0.0};
    Rgb reflect{0.0};
    Rgb local{1.0};
    double shininess = 1.0;
};

struct LoweredChecker {
    Vec3 point{0.0};
    Vec3 u{0.0};  ///< axis / size of a square
    Vec3 v{0.0};
};

/// A scene brought down to what the kernels know: spheres and planes by kind, one equation of
/// shading, world space, double precision.
struct LoweredScene {
    std::vector<LoweredSphere> spheres;  ///< rising object numbers
    std::vector<LoweredPlane> planes;
    std::vector<abi::MaterialIndex> material_index;  ///< by object
    std::vector<LoweredMaterial> materials;
    std::vector<LoweredChecker> checkers;
    std::vector<Light> lights;  ///< none ambient
    Rgb background{0.0};
    int max_depth = 0;
    bool shadows = true;
    double epsilon = 0.0;       ///< start of secondary and shadow rays, in direction lengths
    double camera_t_min = 0.0;  ///< start of camera rays
};

/// Lowers a scene. Throws SceneError for what it can't hold.
[[nodiscard]] LoweredScene lower(const Scene& scene);

}  // namespace packtrace
