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

// Where the time of a frame goes. All times are measured, in frames that are rendered in turns.
// With one thread they are CPU times of this program, with several they are wall-clock times. No
// time is negative.
namespace packtrace {

struct ProfileOptions {
    std::string isa = "auto";
    int threads = 1;
    int samples = 1;                      ///< RenderOptions::samples
    std::optional<double> adaptive = {};  ///< RenderOptions::adaptive
    Accuracy accuracy = RenderOptions{}.accuracy;
    SelfHits self_hits = default_self_hits;
    int repetitions = 9;
};

/// A stage of the way from the scene's text to the bytes of a file.
struct ProfileStage {
    std::string name;
    double seconds = 0.0;
};

/// A one-time cost before frames reach their full speed. Each step happens once per process, so
/// there is no spread.
struct FirstFrameStep {
    std::string name;  ///< "first frame"
    double seconds = 0.0;
    std::uint64_t page_faults = 0;  ///< first touches of pages of code and data
};

/// The cost of the rays of one generation: the difference between frames that end after this
/// generation and frames that end before it.
struct ProfileGeneration {
    int depth = 0;  ///< number of reflections and refractions before
    FrameCounts rays;
    double seconds = 0.0;
    double spread = 0.0;  ///< seconds; the middle half of the differences of consecutive frames
    /// Share of lanes with a ray, in the packets of this generation; not set without rays.
    std::optional<double> lanes_filled = {};
};

/// The cost of one feature: the time of a frame without it, or with one more.
struct ProfileWhatIf {
    std::string name;        ///< "without shadows"
    double seconds = 0.0;    ///< of the changed frame
    bool does_more = false;  ///< the changed frame has one feature more
    /// Seconds that the change saves or, if does_more, costs: the median of the differences of
    /// consecutive frames; 0 if that has the wrong sign.
    double difference = 0.0;
    double spread = 0.0;  ///< seconds; the middle half of these differences
    FrameCounts rays;     ///< of the changed frame
};

/// The time of one stage of the kernels, for the rays of one generation.
struct KernelStage {
    int depth = 0;
    /// The kind of the rays: "camera", "shadow", "reflected", "refracted"; or "hits" for the work
    /// after a hit: local light, child rays, pixels.
    std::string rays;
    std::string name;  ///< "spheres"
    double seconds = 0.0;
};

/// The time of all work for the rays of one kind and generation, from their creation to their hits.
struct RayTime {
    int depth = 0;
    std::string rays;  ///< "camera", "shadow", "reflected", "refracted"
    std::uint64_t count = 0;
    double seconds = 0.0;
};

/// How full the packets of a generation are during one kind of work.
struct LaneUse {
    int depth = 0;
    std::string work;           ///< "closest hits"
    std::uint64_t packets = 0;  ///< packets with at least one active ray
    std::uint64_t live = 0;     ///< active rays in these packets
    /// Packets with a ray in every lane whose rays all have one result: all hit one surface, all
    /// are lit, or all are in shadow. Not set for work without such a result.
    std::optional<std::uint64_t> coherent = {};
};

/// Tests of boxes and objects for the rays of a generation.
struct TestUse {
    int depth = 0;
    std::string rays;    ///< "closest" or "shadow"
    std::string tested;  ///< "nodes", or a kind of object: "spheres"
    /// Objects: tests of a packet against one object. Nodes: tests by frustums of several rays.
    std::uint64_t tests = 0;
    /// Objects: pairs of an active ray and an object in these tests. Nodes: tests by single rays.
    std::uint64_t single = 0;
};

/// Rays of a generation that single precision could not decide, for one cause.
struct UnsureUse {
    int depth = 0;
    std::string rays;         ///< "closest" or "shadow"
    std::string cause;        ///< of unsure_causes()
    std::uint64_t count = 0;  ///< above 0
};

/// The work inside a frame on one thread, recorded by observing kernels. They have all features,
/// and hooks that the other kernels are compiled without.
struct KernelProfile {
    // Seconds of a frame: the sum over its tiles of the median time of each.
    double plain = 0.0;     ///< with the kernels that render the scene
    double observed = 0.0;  ///< with the observing kernels, which do not read the clock
    double clocked = 0.0;   ///< with the observing kernels, which read the clock
    std::vector<KernelStage> stages;
    std::vector<RayTime> rays;
    std::vector<LaneUse> lanes;
    std::vector<TestUse> tests;
    std::vector<UnsureUse> unsure;  ///< empty for double packets and with Accuracy::fast
};

struct Profile {
    int width = 0;
    int height = 0;
    std::string isa;
    int lanes = 0;
    int threads = 1;
    FrameCounts rays;
    double frame = 0.0;         ///< seconds, median
    double frame_spread = 0.0;  ///< width of the middle half of the repetitions / median
    double whole = 0.0;         ///< seconds from the scene's text to the PNG's bytes
    /// Cold only in the first profile of a process that has rendered nothing before.
    std::vector<FirstFrameStep> first_frame;
    std::vector<ProfileStage> stages;
    /// Empty with adaptive sampling, because frames that end earlier refine other pixels.
    std::vector<ProfileGeneration> generations;
    std::vector<ProfileWhatIf> what_if;
    KernelProfile kernels;
    /// What could not be measured because the machine was busy, one sentence each; empty on an idle
    /// machine.
    std::vector<std::string> too_busy;
};

/// Profiles a frame of `scene`. `text` is the scene's text, to time its reading; `scene` may differ
/// from it in size and depth. `Real` is float or double. Throws std::invalid_argument for options
/// out of range, and SceneError as validate() does; so do trace_tiles() and pixel_costs().
template <class Real>
[[nodiscard]] PACKTRACE_API Profile profile(const std::string& text, const Scene& scene,
                                            const ProfileOptions& options = {});

/// The time of a tile, or of a block of tiles that are rendered together, on its thread.
struct TileSpan {
    int x = 0;           ///< column of the first pixel
    int y = 0;           ///< row of the first pixel
    int thread = 0;      ///< from 0, in the order in which threads start their first tile
    double start = 0.0;  ///< seconds after the start of the frame
    double seconds = 0.0;
    std::uint64_t rays = 0;
};

/// The tiles or blocks of one frame, sorted by start time.
template <class Real>
[[nodiscard]] PACKTRACE_API std::vector<TileSpan> trace_tiles(const Scene& scene,
                                                              const ProfileOptions& options = {});

/// Seconds of each pixel's rays, in reading order: the time of a packet whose lanes all trace that
/// pixel, divided by the number of lanes. The cost of divergence between neighbouring pixels is not
/// included.
template <class Real>
[[nodiscard]] PACKTRACE_API std::vector<double> pixel_costs(const Scene& scene,
                                                            const ProfileOptions& options = {});

/// The costs as a picture, from black for the lowest through blue, green, yellow and red to white
/// for the highest. Below it is a bar with the scale in nanoseconds.
[[nodiscard]] PACKTRACE_API Image<float> cost_picture(const std::vector<double>& seconds, int width,
                                                      int height);

}  // namespace packtrace
