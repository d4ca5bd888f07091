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

/// How occluders affect light. none: there are no shadow rays. opaque: any occluder stops the
/// light. transparent: each occluder passes on the share that its material transmits (note 002's
/// pseudo-soft shadows).
enum class ShadowKind { none, opaque, transparent };

/// What a ray gets at the depth limit of the `general` model; the notes have their own rule.
enum class DepthLimit { background, local };

struct Object {
    std::string name = {};  ///< "sphere 1", "plane 2", … when the file gives none
    Surface surface = {};
    /// From the object's own space to the world, applied after the surface's own placement.
    Mat4 transform{1.0};
    Material material = {};
    bool casts_shadow = true;  ///< false: no light is stopped by it
};

/// A scene as its file says it, in double precision. Object numbers are indices into
/// `objects`; where two surfaces are hit at the same t the lower number wins.
struct Scene {
    int width = 512;   ///< pixels
    int height = 512;  ///< pixels
    Rgb background{0.0};
    Illumination illumination = Illumination::scratch;
    int max_depth = 3;  ///< reflections and refractions after the camera ray, >= 0
    /// A mirrored or refracted ray is not traced, and brings nothing, where its colour would be
    /// multiplied by less than this in every channel on its way to the eye; 0 … 1. What is less by
    /// no more than 2⁻¹⁶ of it, as products are by rounding, counts as equal.
    double min_weight = 0.0;
    DepthLimit depth_limit = DepthLimit::local;
    ShadowKind shadows = ShadowKind::opaque;
    Camera camera = {};
    std::vector<Object> objects = {};
    std::vector<Light> lights = {};
    std::optional<Animation> animation = {};
};

}  // namespace packtrace
