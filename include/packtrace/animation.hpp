#pragma once

#include <packtrace/vec.hpp>

#include <optional>
#include <vector>

namespace packtrace {

/// The camera circles around an axis through `center` and looks at `center`.
struct Orbit {
    Vec3 center{0.0};          ///< scene units
    Vec3 axis{0.0, 1.0, 0.0};  ///< need not be unit
    double degrees = 360.0;    ///< swept over the whole animation; the first frame is at 0
};

/// The camera's pose at one frame; poses between keys are interpolated.
struct CameraKey {
    int frame = 0;
    Vec3 position{0.0};
    Vec3 look_at{0.0, 0.0, 1.0};
    Vec3 up{0.0, 1.0, 0.0};
};

/// Camera animation of note 002: either an orbit, or at least two keys in ascending frame order.
struct Animation {
    int frames = 1;  ///< >= 1
    std::optional<Orbit> orbit;
    std::vector<CameraKey> keys;
};

}  // namespace packtrace
