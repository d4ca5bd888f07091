#include "dispatch/kernels.hpp"
#include "image/formats.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "lab/profile/profile_steps.hpp"
#include "lab/profile/work_rows.hpp"
#include "lower/packed_scene.hpp"
#include <packtrace/profile.hpp>
#include <packtrace/read_scene.hpp>

#include <cstddef>

namespace packtrace {
namespace {

FrameCounts operator-(const FrameCounts& a, const FrameCounts& b)
{
    return {a.camera - b.camera, a.shadow - b.shadow, a.reflected - b.reflected,
            a.refracted - b.refracted, a.unsure - b.unsure};
}

// Times stages that follow each other.
class StageClock {
public:
    explicit StageClock(int threads) : threads_(threads)
    {
    }

    template <class Work>
    auto time(const std::string& name, const Work& work)
    {
        const Stopwatch watch(threads_);
        auto result = work();
        stages.push_back({name, watch.seconds()});
        return result;
    }
    std::vector<ProfileStage> stages;

private:
    int threads_;
};

// Times the whole way from text to PNG once; `whole` receives its seconds.
template <class Real>
std::vector<ProfileStage> stages_once(const std::string& text, const Scene& scene,
                                      const ProfileOptions& options, int lanes, double& whole)
{
    const Stopwatch watch(options.threads);
    StageClock clock(options.threads);
    Scene read = clock.time("scene load", [&] { return parse_scene(text, "scene"); });
    read.width = scene.width;
    read.height = scene.height;
    read.max_depth = scene.max_depth;
    read.min_weight = scene.min_weight;
    read.camera = scene.camera;
    const LoweredScene lowered =
        clock.time("lowering", [&] { return lower_for<Real>(read, render_options(options)); });
    // The renderer packs the scene itself. Here packing is timed alone.
    const Stopwatch packing(options.threads);
    {
        const PackedScene<Real> scene_in_arrays(
            lowered, frame_traversal(lowered, Traversal::automatic, lanes));
    }
    const double packed = packing.seconds();
    const Stopwatch making(options.threads);
    const Renderer<Real> renderer(read, render_options(options));
    const double extra = making.seconds();
    clock.stages.push_back({"packing, hierarchy of boxes", packed});
    Image<Real> image;
    clock.time("frame", [&] { return renderer.render(image); });
    const Bytes png =
        clock.time("encoding as PNG", [&] { return encode_png(convert<float>(image)); });
    whole = watch.seconds() - extra;
    return clock.stages;
}

template <class Real>
void measure_stages(const std::string& text, const Scene& scene, const ProfileOptions& options,
                    Profile& result)
{
    std::vector<std::vector<double>> seconds;
    std::vector<double> wholes;
    for (int i = 0; i < options.repetitions; ++i) {
        double whole = 0.0;
        result.stages = stages_once<Real>(text, scene, options, result.lanes, whole);
        wholes.push_back(whole);
        seconds.resize(result.stages.size());
        for (std::size_t stage = 0; stage < seconds.size(); ++stage)
            seconds[stage].push_back(result.stages[stage].seconds);
    }
    for (std::size_t stage = 0; stage < seconds.size(); ++stage)
        result.stages[stage].seconds = median_of(seconds[stage]);
    result.whole = median_of(wholes);
}

// A generation is the difference of two frames: one that ends after it, and one that ends before
// it.
void add_generations(const std::vector<ProfileRun>& runs, int max_depth, Profile& result)
{
    const auto run_to = [&](int depth) -> const ProfileRun& {
        return depth < max_depth ? runs[static_cast<std::size_t>(depth) + 1] : runs.front();
    };
    result.generations.push_back(
        {0, run_to(0).rays, median_of(run_to(0).seconds), middle_half(run_to(0).seconds), {}});
    for (int depth = 1; depth <= max_depth; ++depth) {
        const ProfileRun& run = run_to(depth);
        const ProfileRun& before = run_to(depth - 1);
        const TimeDifference more = time_difference(run.seconds, before.seconds);
        result.generations.push_back(
            {depth, run.rays - before.rays, more.seconds, more.spread, {}});
    }
}

void add_what_if(const ProfileRun& frame, const ProfileRun& run, Profile& result)
{
    const TimeDifference difference = run.does_more ? time_difference(run.seconds, frame.seconds)
                                                    : time_difference(frame.seconds, run.seconds);
    result.what_if.push_back({run.name, median_of(run.seconds), run.does_more, difference.seconds,
                              difference.spread, run.rays});
}

}  // namespace

template <class Real>
Profile profile(const std::string& text, const Scene& scene, const ProfileOptions& options)
{
    const IsaInfo isa = choose_isa(options.isa);
    Profile result;
    result.width = scene.width;
    result.height = scene.height;
    result.isa = isa.name;
    result.lanes = sizeof(Real) == sizeof(float) ? isa.lanes_single : isa.lanes_double;
    result.threads = options.threads;

    // First, while the process is cold.
    result.first_frame = first_frame_steps<Real>(scene, options);
    std::vector<ProfileRun> runs = profile_runs<Real>(scene, options);
    take_times(runs, options);
    result.rays = runs.front().rays;
    result.frame = median_of(runs.front().seconds);
    result.frame_spread = relative_spread(runs.front().seconds);
    if (!options.adaptive)
        add_generations(runs, scene.max_depth, result);
    const ObservedKernels observed = observe_kernels<Real>(scene, options);
    result.kernels = observed.profile;
    for (ProfileGeneration& generation : result.generations)
        generation.lanes_filled =
            lanes_filled(observed.counts[static_cast<std::size_t>(generation.depth)], result.lanes);
    const auto first = static_cast<std::size_t>(generations_apart(scene, options)) + 1;
    for (std::size_t i = first; i < runs.size(); ++i)
        add_what_if(runs.front(), runs[i], result);
    measure_stages<Real>(text, scene, options, result);
    result.too_busy = busy_lines(result);
    return result;
}

template Profile profile<float>(const std::string&, const Scene&, const ProfileOptions&);
template Profile profile<double>(const std::string&, const Scene&, const ProfileOptions&);

}  // namespace packtrace
