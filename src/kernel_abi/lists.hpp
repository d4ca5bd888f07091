#pragma once

#include <cstdint>
#include <type_traits>

// Plain views of the lowered scene as the kernels read it. Arrays belong to the host, are
// 64-byte aligned and padded so that reading a whole packet from any valid index is safe.
namespace packtrace::abi {

/// Readable elements behind the last valid one of every array.
inline constexpr int padding = 16;

/// An integer as wide as a real, so that both fill the same lanes.
template <class Real>
using lane_int = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

/// Spheres |P - center|² = radius², in rising object order.
template <class Real>
struct SphereListView {
    const Real* center_x = nullptr;
    const Real* center_y = nullptr;
    const Real* center_z = nullptr;
    const Real* radius = nullptr;
    const Real* radius2 = nullptr;  ///< radius², rounded once from double
    const lane_int<Real>* object = nullptr;
    int count = 0;
};

/// A sphere much larger than the scene, by a point of its surface near the scene:
/// 2 n·p + k p·p + k0 = 0 with p = P - anchor, where n is the outward normal at the anchor,
/// k the curvature 1/r and k0 = (|anchor - center|² - r²) / r makes up for the anchor's rounding.
template <class Real>
struct HugeSphere {
    Real anchor[3];
    Real normal[3];
    Real curvature;
    Real offset;  ///< k0
    std::int32_t object;
};

/// normal·(P - point) = 0.
template <class Real>
struct PlaneRecord {
    Real point[3];
    Real normal[3];
    std::int32_t object;
};

template <class Record>
struct RecordList {
    const Record* data = nullptr;
    int count = 0;
};

}  // namespace packtrace::abi
