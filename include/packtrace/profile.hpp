#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Where a frame's time goes. Everything is measured, in frames taken in turns. On one thread, times
// are the processor's for this program; on several, those of the clock. None is negative.
namespace packtrace {

struct ProfileOptions {
    std::string isa = "auto";
    int threads = 1;
    int samples = 1;  ///< as RenderOptions has them, and adaptive
    std::optional<double> adaptive = {};
    Accuracy accuracy = RenderOptions{}.accuracy;
    SelfHits self_hits = default_self_hits;
    int repetitions = 9;
};

/// A part of the way from the lowered scene's text to a file's bytes.
struct ProfileStage {
    std::string name;
    double seconds = 0.0;
};

/// What a process pays before its frames are as fast as they get. Each step happens once, so that
/// no spread is known.
struct FirstFrameStep {
    std::string name;  ///< "first frame"
    double seconds = 0.0;
    std::uint64_t page_faults = 0;  ///< pages of memory first touched, of code and data
};

/// What the rays of one generation took: the difference between frames that end after it and before
/// it.
struct ProfileGeneration {
    int depth = 0;  ///< reflections and refractions before
    FrameCounts rays;
    double seconds = 0.0;
    double spread = 0.0;  ///< seconds; the middle half of the differences between frames in turn
    /// Share of lanes with a ray in the packets that its rays are traced in; none without rays.
    std::optional<double> lanes_filled = {};
};

/// The frame without one thing, and so what that costs; or with one thing more.
struct ProfileWhatIf {
    std::string name;      ///< "without shadows"
    double seconds = 0.0;  ///< of that frame
    bool does_more = false;
    /// What it saves or, where it does more, what it costs: the median of the differences between
    /// frames in turn, 0 where they have the wrong sign.
    double difference = 0.0;
    double spread = 0.0;  ///< seconds; the middle half of these differences
    FrameCounts rays;     ///< of that frame
};

/// A part of the kernels' work for the rays of one generation.
struct KernelStage {
    int depth = 0;
    /// Whose work it is: "camera", "shadow", "reflected", "refracted", or "hits" for what is done
    /// where rays hit: local light, child rays, pixels.
    std::string rays;
    std::string name;  ///< "spheres"
    double seconds = 0.0;
};

/// All that is done for the rays of one kind and generation, from their making to their hits.
struct RayTime {
    int depth = 0;
    std::string rays;  ///< "camera", "shadow", "reflected", "refracted"
    std::uint64_t count = 0;
    double seconds = 0.0;
};

/// How packets of a generation are filled as they do one thing.
struct LaneUse {
    int depth = 0;
    std::string work;           ///< "closest hits"
    std::uint64_t packets = 0;  ///< that do it for at least one ray
    std::uint64_t live = 0;     ///< rays they do it for
    /// Packets with a ray in every lane that all come to the same: one surface hit, or all lit,
    /// or all in shadow. None for work without such a result.
    std::optional<std::uint64_t> coherent = {};
};

/// Tests of boxes and objects for the rays of a generation.
struct TestUse {
    int depth = 0;
    std::string rays;         ///< "closest" or "shadow"
    std::string tested;       ///< "nodes", or a kind of object: "spheres"
    std::uint64_t tests = 0;  ///< of packets against one object; nodes by frustums of several rays
    /// Objects: pairs of a live ray and an object in them. Nodes: met by single rays.
    std::uint64_t single = 0;
};

/// Rays of a generation that single precision could not decide about, for one cause.
struct UnsureUse {
    int depth = 0;
    std::string rays;         ///< "closest" or "shadow"
    std::string cause;        ///< of unsure_causes()
    std::uint64_t count = 0;  ///< above 0
};

/// The inside of a frame, on one thread, by kernels that observe themselves: those with every
/// feature, and hooks that other kernels are compiled without.
struct KernelProfile {
    // Seconds of a frame's tiles, each by the median of its times.
    double plain = 0.0;     ///< by the kernels that render the scene
    double observed = 0.0;  ///< by those that can observe, with the clock at rest
    double clocked = 0.0;   ///< by the same with the clock
    std::vector<KernelStage> stages;
    std::vector<RayTime> rays;
    std::vector<LaneUse> lanes;
    std::vector<TestUse> tests;
    std::vector<UnsureUse> unsure;  ///< none for packets of doubles, or in fast accuracy
};

struct Profile {
    int width = 0;
    int height = 0;
    std::string isa;
    int lanes = 0;
    int threads = 1;
    FrameCounts rays;
    double frame = 0.0;         ///< seconds, median
    double frame_spread = 0.0;  ///< of the middle half of the repetitions, over the median
    double whole = 0.0;         ///< seconds from the scene's text to the PNG's bytes
    /// Cold only in the first profile of a process that has rendered nothing before.
    std::vector<FirstFrameStep> first_frame;
    std::vector<ProfileStage> stages;
    /// None with adaptive sampling: frames that end earlier refine other pixels.
    std::vector<ProfileGeneration> generations;
    std::vector<ProfileWhatIf> what_if;
    KernelProfile kernels;
    /// What the machine was too busy to tell, a sentence each; none on an idle machine.
    std::vector<std::string> too_busy;
};

/// `text` is read as a scene for the stages' sake, then changed as `scene` says: size, depth.
/// `Real` is float or double. Throws std::invalid_argument for options out of their ranges, and
/// SceneError for a scene that cannot be used; so do trace_tiles() and pixel_costs().
template <class Real>
[[nodiscard]] PACKTRACE_API Profile profile(const std::string& text, const Scene& scene,
                                            const ProfileOptions& options = {});

/// The time of a tile, or of a block of tiles that are rendered together, on its thread.
struct TileSpan {
    int x = 0;  ///< first pixel
    int y = 0;
    int thread = 0;      ///< counted from 0 in the order of their first ones
    double start = 0.0;  ///< seconds after the frame's
    double seconds = 0.0;
    std::uint64_t rays = 0;
};

/// The tiles or blocks of one frame, by their start.
template <class Real>
[[nodiscard]] PACKTRACE_API std::vector<TileSpan> trace_tiles(const Scene& scene,
                                                              const ProfileOptions& options = {});

/// Seconds of each pixel's rays, in reading order: packets full of that pixel alone, over their
/// lanes. What rays of neighbours cost each other by parting ways is not in it.
template <class Real>
[[nodiscard]] PACKTRACE_API std::vector<double> pixel_costs(const Scene& scene,
                                                            const ProfileOptions& options = {});

/// The costs as a picture, black for the least through blue, green, yellow and red to white for
/// the most, over a bar with its scale in nanoseconds.
[[nodiscard]] PACKTRACE_API Image<float> cost_picture(const std::vector<double>& seconds, int width,
                                                      int height);

}  // namespace packtrace
