#pragma once

#include <cstdint>

#include "kernel_abi/lists.hpp"

// Stiff objects: those that single precision cannot hold well, tested in double for rays in
// single. Each is one surface, or with caps three.
namespace packtrace::abi {

enum class StiffKind : std::int32_t { sphere, huge_sphere, plane, quadric };

struct StiffSphere {
    double center[3];
    double radius2;
};

/// The record of its kind is set.
struct StiffObject {
    StiffKind kind;
    std::int32_t surface;
    /// A ball around the surface that single precision may reject rays by: its centre and the
    /// square of its radius, which is infinite for an unbounded surface. See docs/numerics.md for
    /// what is added for rounding.
    float bound[3];
    float bound_radius;   ///< of the ball, rounded up
    float bound_radius2;  ///< (1 + 32 u) r² + 4 u |centre|²
    union {
        StiffSphere sphere;
        HugeSphere<double> huge;
        PlaneRecord<double> plane;
        QuadricRecord<double> quadric;
    };
};

}  // namespace packtrace::abi
