#pragma once

#include <embree3/rtcore.h>

namespace packtrace::peers {

/// A sphere's record, for Embree's sphere geometry and for user geometry.
struct alignas(16) SphereRecord {
    float center[3];
    float radius;
};

/// Callbacks of a user geometry whose user pointer is an array of SphereRecord. They test packets
/// of 4, 8 and 16 rays with vectors of the machine, and obey masks.
struct UserSphere {
    RTCIntersectFunctionN intersect = nullptr;
    RTCOccludedFunctionN occluded = nullptr;
};

[[nodiscard]] UserSphere user_sphere_avx512();
[[nodiscard]] UserSphere user_sphere_avx2();

}  // namespace packtrace::peers
