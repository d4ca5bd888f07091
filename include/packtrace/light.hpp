#pragma once

#include <packtrace/vec.hpp>

namespace packtrace {

enum class LightType { ambient, point, directional };

struct Light {
    LightType type = LightType::ambient;
    /// Linear, 1.0 is full intensity; not attenuated by distance.
    Rgb intensity{1.0};
    /// A point light's position, or the direction *towards* a directional light (any length).
    Vec3 vector{0.0};
    bool casts_shadow = true;  ///< false: no object occludes the light
};

}  // namespace packtrace
