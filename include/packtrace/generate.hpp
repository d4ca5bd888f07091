#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>

// Procedural scenes. Equal options give equal scenes on every machine. Pictures have 1024 x 1024
// pixels, the illumination is that of note 001, and each object has the name that the reader would
// give it. All functions throw std::invalid_argument, with one line, for options out of range. A
// scene file can hold two million spheres; scene_text() rejects more.
namespace packtrace {

/// The "balls" of Haines, A Proposal for Standard Graphics Environments, 1987: a sphere of
/// radius 1/2 has nine children of a third of its radius, each child has nine, and so on.
struct SphereflakeOptions {
    int depth = 4;            ///< generations of children, 0 to 7: 7381 spheres at 4, 597871 at 6
    double reflective = 0.0;  ///< share of the mirrored light, 0 to 1
    /// Adds the plane z = -1/2, on which the root stands, and uses three lights instead of one.
    bool ground = false;
};
[[nodiscard]] PACKTRACE_API Scene generate_sphereflake(const SphereflakeOptions& options = {});

/// Spheres of one radius. Their centres are distributed uniformly in the unit cube from the origin
/// to (1, 1, 1). Coordinates are multiples of 1e-7, so that a scene file needs few digits.
struct RandomSpheresOptions {
    int count = 1'000'000;  ///< 1 to 10'000'000
    double radius = 0.001;  ///< above 0
    std::uint64_t seed = 1;
    double reflective = 0.0;  ///< share of the mirrored light, 0 to 1
};
[[nodiscard]] PACKTRACE_API Scene generate_random_spheres(const RandomSpheresOptions& options = {});

/// edge x edge x edge spheres, at the centres of equal cells of the unit cube.
struct LatticeOptions {
    int edge = 10;            ///< spheres along each edge, 1 to 215
    double radius = 0.3;      ///< in cell edges, above 0; neighbours touch at 0.5
    double reflective = 0.0;  ///< share of the mirrored light, 0 to 1
};
[[nodiscard]] PACKTRACE_API Scene generate_lattice(const LatticeOptions& options = {});

}  // namespace packtrace
