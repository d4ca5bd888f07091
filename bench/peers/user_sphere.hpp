#pragma once

#include <embree3/rtcore.h>

namespace packtrace::peers {

/// What Embree is given of a sphere, as sphere and as user geometry alike.
struct alignas(16) SphereRecord {
    float center[3];
    float radius;
};

/// Callbacks of a user geometry whose user pointer is an array of SphereRecord. Lanes are rays,
/// masks are honoured; 4, 8 and 16 lanes take one instruction each where the machine has it.
struct UserSphere {
    RTCIntersectFunctionN intersect = nullptr;
    RTCOccludedFunctionN occluded = nullptr;
};

[[nodiscard]] UserSphere user_sphere_avx512();
[[nodiscard]] UserSphere user_sphere_avx2();

}  // namespace packtrace::peers
