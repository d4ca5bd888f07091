#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace packtrace {

/// A point or direction. World space is left-handed, with y up and z forward.
using Vec3 = glm::dvec3;

/// A linear colour, or a coefficient per channel. Scene files write the colour 1.0 as 255.
using Rgb = glm::dvec3;

using Vec2 = glm::dvec2;
using Mat3 = glm::dmat3;

/// An affine map in homogeneous form; its last row is (0, 0, 0, 1).
using Mat4 = glm::dmat4;

static_assert(sizeof(Vec3) == 3 * sizeof(double),
              "packtrace is built without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES; define it after "
              "packtrace's headers, or not at all");

}  // namespace packtrace
