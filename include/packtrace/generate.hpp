#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>

// Procedural scenes. The same options give the same scene on every machine; pictures are
// 1024 x 1024 pixels, lit after note 001, each object named as the reader would name it.
// All throw std::invalid_argument, in one line, for options out of the range given here. A scene
// file holds two million spheres; scene_text() refuses more.
namespace packtrace {

/// The "balls" of Haines, A Proposal for Standard Graphics Environments, 1987: a sphere of
/// radius 1/2 with nine children of a third of its radius, each of which has nine, and so on.
struct SphereflakeOptions {
    int depth = 4;            ///< generations of children, 0 to 7: 7381 spheres at 4, 597871 at 6
    double reflective = 0.0;  ///< share of the mirrored light, 0 to 1
    /// Stands the root on the plane z = -1/2 and lights it by all three lamps, not one only.
    bool ground = false;
};
[[nodiscard]] PACKTRACE_API Scene generate_sphereflake(const SphereflakeOptions& options = {});

/// Spheres of one radius, their centres spread evenly over the unit cube from the origin to
/// (1, 1, 1), on a grid of 1e-7 so that their numbers are short.
struct RandomSpheresOptions {
    int count = 1'000'000;  ///< 1 to 10'000'000
    double radius = 0.001;  ///< above 0
    std::uint64_t seed = 1;
    double reflective = 0.0;  ///< share of the mirrored light, 0 to 1
};
[[nodiscard]] PACKTRACE_API Scene generate_random_spheres(const RandomSpheresOptions& options = {});

/// edge x edge x edge spheres in the middles of equal cells of the unit cube.
struct LatticeOptions {
    int edge = 10;            ///< spheres along each edge, 1 to 215
    double radius = 0.3;      ///< in cells, above 0; neighbours touch at 0.5
    double reflective = 0.0;  ///< share of the mirrored light, 0 to 1
};
[[nodiscard]] PACKTRACE_API Scene generate_lattice(const LatticeOptions& options = {});

}  // namespace packtrace
