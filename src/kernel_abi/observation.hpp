#pragma once

#include <cstdint>

// What kernels compiled with Features::probe record of a tile's work, for the stages that
// packtrace/profile.hpp describes.
namespace packtrace::abi {

/// Stages follow each other through a tile without a gap; each generation has its own.
enum class Stage : std::int32_t {
    setup,     ///< what the tile's cone may meet
    trace,     ///< rays to their closest hits
    shadows,   ///< what may stand between the hits and lights; with a hierarchy the shadow rays
    shade,     ///< local light, child rays; without a hierarchy shadow rays, packet by packet
    children,  ///< refracted rays put behind mirrored ones
    film       ///< the background into the pixels, and these into the picture
};
inline constexpr int stage_count = 6;

/// What the time of a stage goes to.
enum class Step : std::int32_t {
    cones,           ///< the objects that a cone may meet
    ray_generation,  ///< of camera and shadow rays; of others the loading
    boxes,           ///< traversal: nodes of the hierarchy, frustums and orders of rays
    spheres,
    anchored_spheres,
    planes,
    quadrics,
    polygons,
    retrace,     ///< unsure rays traced again in double
    compaction,  ///< hits to a stream, with those that are solved again
    surface,     ///< normals and materials at hits
    diffuse,     ///< directions and cosines of lights, and all of local light but
    highlight,   ///< the powers of highlights
    children,    ///< directions and weights of child rays, and their way into streams
    film         ///< light into pixels
};
inline constexpr int step_count = 15;

/// Whether work is done for shadow rays, or for those they start from.
enum class RayPurpose : std::int32_t { own, shadow };
inline constexpr int purpose_count = 2;

/// The clock at the borders of a generation's stages.
struct StageTicks {
    std::uint64_t stage[stage_count] = {};  ///< ticks
    double refracted = 0;  ///< ticks of Stage::trace for refracted rays, by their share of a chunk
};

struct Ticks {
    std::uint64_t ticks = 0;
    std::uint64_t reads = 0;  ///< of the clock, whose own time is in `ticks`
};

/// The clock wherever steps begin and end, read after all that was begun before has finished.
struct StepTicks {
    Ticks step[stage_count][purpose_count][step_count];
};

/// Packets that did something for at least one ray.
struct PacketCounts {
    std::uint64_t packets = 0;
    std::uint64_t live = 0;      ///< lanes of them that did it for a ray
    std::uint64_t coherent = 0;  ///< packets with a ray in every lane, all with the same result
};

/// What packets are counted at. The result of `trace` is the surface hit, and that of `shadow` to
/// be lit or not; the others have none.
enum class PacketWork : std::int32_t { trace, shadow, shade, highlight, children };
inline constexpr int packet_work_count = 5;

/// Tests of one kind of object.
struct TestCounts {
    std::uint64_t packets = 0;  ///< packets tested against one object, or objects against one ray
    std::uint64_t pairs = 0;    ///< of a live ray and an object in them
};

enum class Primitive : std::int32_t { sphere, anchored_sphere, plane, quadric, polygon };
inline constexpr int primitive_count = 5;

/// Why single precision could not decide about a ray.
enum class Cause : std::int32_t {
    tangent,   ///< it may touch a surface or pass it, or nothing tells two roots apart
    order,     ///< either of two objects may come first
    range,     ///< a hit may lie on either side of an end of the ray
    clip,      ///< either of two pieces of one object may come first, as at a rim
    magnitude  ///< its numbers, or the scene's, are beyond those that error bounds hold for
};
inline constexpr int cause_count = 5;

/// The rays of a pixel's tree.
struct PixelRays {
    std::uint32_t traced = 0;
    std::uint32_t unsure = 0;     ///< of these, traced again in double
    std::uint32_t undecided = 0;  ///< of these, such as double cannot decide either
};

/// What happened in a generation.
struct WorkCounts {
    PacketCounts work[packet_work_count];
    TestCounts tests[purpose_count][primitive_count];
    std::uint64_t group_nodes[purpose_count] = {};  ///< nodes met by frustums of rays
    std::uint64_t ray_nodes[purpose_count] = {};    ///< nodes met by single rays
    std::uint64_t untraced = 0;                     ///< camera rays of tiles that can meet nothing
    std::uint64_t refracted = 0;                    ///< of the rays traced
    std::uint64_t unsure[purpose_count][cause_count] = {};  ///< rays traced again in double
};

/// What to record, added to what is there: any of three arrays of `generations` elements, the last
/// of which takes all later ones too. Steps are not clocked together with stages. Pixels are those
/// of the tile, by their numbers along its Z-order curve; camera rays of tiles that can meet
/// nothing are not counted there.
struct Observation {
    int generations = 0;
    StageTicks* stages = nullptr;
    StepTicks* steps = nullptr;
    WorkCounts* counts = nullptr;
    PixelRays* pixels = nullptr;
    std::uint64_t end = 0;      ///< the clock as the last tile ended
    std::uint64_t reading = 0;  ///< ticks that a reading of the clock takes between steps
};

}  // namespace packtrace::abi
