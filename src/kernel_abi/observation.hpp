#pragma once

#include <cstdint>

// What kernels compiled with Features::probe record of the work on a tile, by the stages that
// packtrace/profile.hpp describes.
namespace packtrace::abi {

/// The stages of a tile follow each other without a gap. Each generation of rays has its own
/// stages.
enum class Stage : std::int32_t {
    setup,     ///< finding the objects that the tile's cone may hit
    trace,     ///< tracing rays to their closest hits
    shadows,   ///< finding occluders of lights; with a BVH, tracing shadow rays
    shade,     ///< local light and child rays; without a BVH, shadow rays, packet by packet
    children,  ///< appending refracted rays to reflected ones
    film       ///< filling pixels with the background, and copying pixels into the picture
};
inline constexpr int stage_count = 6;

/// What the time of a stage is spent on.
enum class Step : std::int32_t {
    cones,           ///< finding the objects that a cone may hit
    ray_generation,  ///< making camera and shadow rays; loading other rays
    boxes,           ///< traversal: nodes of the BVH, frustums and orders of rays
    spheres,
    anchored_spheres,
    planes,
    quadrics,
    polygons,
    retrace,     ///< unsure rays traced again in double
    compaction,  ///< writing hits to a stream, and refining them
    surface,     ///< normals and materials at hits
    diffuse,     ///< directions and cosines of lights, and local light except highlights
    highlight,   ///< powers of highlights
    children,    ///< directions and weights of child rays, and writing them to streams
    film         ///< adding light to pixels
};
inline constexpr int step_count = 15;

/// Whether work is done for shadow rays, or for the rays whose hits they start from.
enum class RayPurpose : std::int32_t { own, shadow };
inline constexpr int purpose_count = 2;

/// Times of the stages of one generation.
struct StageTicks {
    std::uint64_t stage[stage_count] = {};  ///< ticks
    /// Ticks of Stage::trace for refracted rays, by their share of each chunk.
    double refracted = 0;
};

struct Ticks {
    std::uint64_t ticks = 0;
    std::uint64_t reads = 0;  ///< clock readings; `ticks` includes the time they take
};

/// Times of the steps. The clock is read after all earlier instructions have finished.
struct StepTicks {
    Ticks step[stage_count][purpose_count][step_count];
};

/// Packets that did one kind of work for at least one ray.
struct PacketCounts {
    std::uint64_t packets = 0;
    std::uint64_t live = 0;      ///< lanes that did it for a ray
    std::uint64_t coherent = 0;  ///< packets with a ray in every lane, all with the same result
};

/// The work that packets are counted by. The result of `trace` is the surface hit; the result of
/// `shadow` is lit or not lit; the others have no result.
enum class PacketWork : std::int32_t { trace, shadow, shade, highlight, children };
inline constexpr int packet_work_count = 5;

/// Tests of one kind of object.
struct TestCounts {
    /// Packets tested against one object, or packets of objects tested against one ray.
    std::uint64_t packets = 0;
    std::uint64_t pairs = 0;  ///< pairs of a live ray and an object in these tests
};

enum class Primitive : std::int32_t { sphere, anchored_sphere, plane, quadric, polygon };
inline constexpr int primitive_count = 5;

/// Why single precision could not decide a ray.
enum class Cause : std::int32_t {
    tangent,   ///< the ray may touch a surface or miss it, or two roots cannot be told apart
    order,     ///< either of two objects may be hit first
    range,     ///< a hit may lie inside or outside [t_min, t_max]
    clip,      ///< either of two pieces of one object may be hit first, as at a rim
    magnitude  ///< numbers of the ray or the scene are too large or small for the error bounds
};
inline constexpr int cause_count = 5;

/// The rays that a pixel's light comes from.
struct PixelRays {
    std::uint32_t traced = 0;
    std::uint32_t unsure = 0;     ///< traced again in double
    std::uint32_t undecided = 0;  ///< cannot be decided in double either
};

/// Counts of one generation.
struct WorkCounts {
    PacketCounts work[packet_work_count];
    TestCounts tests[purpose_count][primitive_count];
    std::uint64_t group_nodes[purpose_count] = {};  ///< nodes tested against frustums of rays
    std::uint64_t ray_nodes[purpose_count] = {};    ///< nodes tested against single rays
    std::uint64_t untraced = 0;   ///< camera rays of tiles in which no object is visible
    std::uint64_t refracted = 0;  ///< refracted rays among those traced
    std::uint64_t unsure[purpose_count][cause_count] = {};  ///< rays traced again in double
};

/// What to record. Counts are added to any of three arrays of `generations` elements; the last
/// element also receives all later generations. Steps and stages are not clocked together. Pixels
/// are those of the tile, numbered along its Z-order curve; camera rays of tiles in which no object
/// is visible are not counted there.
struct Observation {
    int generations = 0;
    StageTicks* stages = nullptr;
    StepTicks* steps = nullptr;
    WorkCounts* counts = nullptr;
    PixelRays* pixels = nullptr;
    std::uint64_t end = 0;      ///< clock when the last tile ended
    std::uint64_t reading = 0;  ///< ticks that one reading of the clock between steps takes
};

}  // namespace packtrace::abi
