#pragma once

#include <packtrace/animation.hpp>
#include <packtrace/camera.hpp>
#include <packtrace/light.hpp>
#include <packtrace/material.hpp>
#include <packtrace/surface.hpp>

#include <optional>
#include <string>
#include <vector>

namespace packtrace {

/// How occluders affect light. none: no shadow rays. opaque: any occluder stops the light.
/// transparent: each occluder transmits the share of its material (the pseudo-soft shadows of note
/// 002).
enum class ShadowKind { none, opaque, transparent };

/// The colour that replaces the child rays at the depth limit of the `general` model. The notes
/// have their own rules.
enum class DepthLimit { background, local };

struct Object {
    std::string name = {};  ///< "sphere 1", "plane 2", … if the file gives no name
    Surface surface = {};
    /// From object space to world space. The surface's own numbers, such as Sphere::center, are in
    /// object space.
    Mat4 transform{1.0};
    Material material = {};
    bool casts_shadow = true;  ///< false: the object does not occlude lights
};

/// A scene as in its file, in double precision. Objects are identified by their index in `objects`.
/// If a ray hits two objects at the same t, the lower index wins.
struct Scene {
    int width = 512;   ///< pixels
    int height = 512;  ///< pixels
    Rgb background{0.0};
    Illumination illumination = Illumination::scratch;
    int max_depth = 3;  ///< reflections and refractions after the camera ray, >= 0
    /// Range 0 … 1. A mirrored or refracted ray is not traced, and adds no light, if its weight in
    /// the pixel is less than this in every channel. A weight that is less by at most a share of
    /// 2⁻¹⁶, as products are because of rounding, counts as equal.
    double min_weight = 0.0;
    DepthLimit depth_limit = DepthLimit::local;
    ShadowKind shadows = ShadowKind::opaque;
    Camera camera = {};
    std::vector<Object> objects = {};
    std::vector<Light> lights = {};
    std::optional<Animation> animation = {};
};

}  // namespace packtrace
