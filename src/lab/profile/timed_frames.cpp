#include "core/aligned_array.hpp"
#include "core/arena.hpp"
#include "core/check_number.hpp"
#include "dispatch/kernels.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "lab/profile/profile_steps.hpp"
#include "render/camera_view.hpp"
#include "render/frame_renderer.hpp"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <memory>
#include <sys/resource.h>
#include <utility>

// Times of whole frames: the first of a process, and variants of the frame in turns.
namespace packtrace {
namespace {

/// Pages of memory that this program has touched for the first time so far.
std::uint64_t page_faults()
{
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return static_cast<std::uint64_t>(use.ru_minflt) + static_cast<std::uint64_t>(use.ru_majflt);
}

template <class Work>
FirstFrameStep step(const char* name, int threads, const Work& work)
{
    const std::uint64_t before = page_faults();
    const double seconds = seconds_of(threads, work);
    return {name, seconds, page_faults() - before};
}

void start_threads(int threads)
{
    run_on_threads(threads, [threads] {
        tbb::parallel_for(
            0, threads, [](int) {}, tbb::static_partitioner());
    });
}

}  // namespace

template <class Real>
std::vector<FirstFrameStep> first_frame_steps(const Scene& scene, const ProfileOptions& options)
{
    const int threads = options.threads;
    std::vector<FirstFrameStep> steps;
    steps.push_back(step("threads started", threads, [threads] { start_threads(threads); }));
    const Renderer<Real> renderer(scene, render_options(options));
    // Both are kept, because freed memory could be reused while it is warm.
    Image<Real> first, second;
    const auto frame = [&](const char* name, Image<Real>& image) {
        steps.push_back(step(name, threads, [&] { (void)renderer.render(image); }));
    };
    frame("first frame", first);
    frame("second frame, into other memory", second);
    frame("third frame, into the same", second);
    return steps;
}

template std::vector<FirstFrameStep> first_frame_steps<float>(const Scene&, const ProfileOptions&);
template std::vector<FirstFrameStep> first_frame_steps<double>(const Scene&, const ProfileOptions&);

namespace {

template <class Real>
ProfileRun frame_run(const std::string& name, const Scene& scene, const LoweredScene& lowered,
                     const abi::KernelTable& table, const RenderOptions& options)
{
    const auto renderer = std::make_shared<FrameRenderer<Real>>(scene, lowered, table, options);
    const auto image = std::make_shared<Image<Real>>();
    return {name, [renderer, image] { return renderer->render(*image); }};
}

// Camera rays and their closest hits, on this thread.
template <class Real>
class CameraRays {
public:
    CameraRays(const Scene& scene, const LoweredScene& lowered, const abi::KernelTable& table)
        : width_(scene.width),
          height_(scene.height),
          packed_(lowered,
                  frame_traversal(lowered, Traversal::automatic, precision<Real>(table).lanes)),
          camera_(camera_view<Real>(scene, lowered)),
          kernels_(kernels_for(precision<Real>(table), lowered.features)),
          scratch_(kernels_.scratch_bytes(packed_.view(), 1))
    {
    }

    FrameCounts trace()
    {
        abi::TileJob<Real> job{
            .scene = &packed_.view(), .camera = &camera_, .scratch = scratch_.data()};
        for (job.y = 0; job.y < height_; job.y += abi::tile_size)
            for (job.x = 0; job.x < width_; job.x += abi::tile_size) {
                job.width = std::min(abi::tile_size, width_ - job.x);
                job.height = std::min(abi::tile_size, height_ - job.y);
                kernels_.closest_tile(job, hits_);
            }
        return {static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_), 0, 0, 0};
    }

private:
    int width_;
    int height_;
    PackedScene<Real> packed_;
    abi::CameraView<Real> camera_;
    const abi::FeatureKernels<Real>& kernels_;
    AlignedArray<std::byte> scratch_;
    abi::TileHits<Real> hits_;
};

template <class Real>
ProfileRun camera_run(const Scene& scene, const LoweredScene& lowered,
                      const abi::KernelTable& table)
{
    const auto rays = std::make_shared<CameraRays<Real>>(scene, lowered, table);
    return {"camera rays and their closest hits alone", [rays] { return rays->trace(); }};
}

LoweredScene without_highlights(LoweredScene lowered)
{
    for (LoweredMaterial& material : lowered.materials)
        material.highlight = Rgb(0.0);
    return lowered;
}

LoweredScene without_shadows(LoweredScene lowered)
{
    lowered.shadows = false;
    lowered.transparent_shadows = false;
    return lowered;
}

LoweredScene without_lights(LoweredScene lowered)
{
    lowered.lights.clear();
    return lowered;
}

LoweredScene ended_at(LoweredScene lowered, int depth)
{
    lowered.max_depth = depth;
    return lowered;
}

}  // namespace

RenderOptions render_options(const ProfileOptions& options)
{
    check_number("threads", options.threads, 1, most_threads);
    check_number("repetitions", options.repetitions, 1, most_repetitions);
    RenderOptions result{.isa = options.isa,
                         .accuracy = options.accuracy,
                         .self_hits = options.self_hits,
                         .threads = options.threads,
                         .samples = options.samples,
                         .adaptive = options.adaptive};
    return result;
}

TimeDifference time_difference(const std::vector<double>& whole, const std::vector<double>& part)
{
    const std::vector<double> each = differences(whole, part);
    return {std::max(0.0, median_of(each)), middle_half(each)};
}

int generations_apart(const Scene& scene, const ProfileOptions& options)
{
    return options.adaptive ? 0 : scene.max_depth;
}

void take_times(std::vector<ProfileRun>& runs, const ProfileOptions& options)
{
    const auto time = [&](std::size_t i) {
        return seconds_of(options.threads, [&] { runs[i].rays = runs[i].render(); });
    };
    (void)time_in_turns(runs.size(), 1, time);
    auto seconds = time_in_turns(runs.size(), options.repetitions, time);
    for (std::size_t i = 0; i < runs.size(); ++i)
        runs[i].seconds = std::move(seconds[i]);
}

template <class Real>
std::vector<ProfileRun> profile_runs(const Scene& scene, const ProfileOptions& options)
{
    const RenderOptions sampling = render_options(options);
    const LoweredScene lowered = lower_for<Real>(scene, sampling);
    const auto& table = kernels_of(choose_isa(options.isa).name);
    std::vector<ProfileRun> runs;
    const auto add = [&](const std::string& name, const LoweredScene& changed) {
        runs.push_back(frame_run<Real>(name, scene, changed, table, sampling));
    };
    add("frame", lowered);
    for (int depth = 0; depth < generations_apart(scene, options); ++depth)
        add("depth " + std::to_string(depth), ended_at(lowered, depth));
    add("without highlights", without_highlights(lowered));
    add("without shadows", without_shadows(lowered));
    if (scene.max_depth > 0)
        add("without reflections and refractions", ended_at(lowered, 0));
    add("without lights but ambient ones", without_lights(lowered));
    if (options.samples > 1) {
        RenderOptions once = sampling;
        once.samples = 1;
        once.adaptive.reset();
        runs.push_back(frame_run<Real>("without anti-aliasing", scene, lowered, table, once));
    }
    RenderOptions general = sampling;
    general.force_general = true;
    runs.push_back(frame_run<Real>("with all that was left out", scene, lowered, table, general));
    runs.back().does_more = true;
    if (options.threads == 1 && options.samples == 1)
        runs.push_back(camera_run<Real>(scene, lowered, table));
    return runs;
}

template std::vector<ProfileRun> profile_runs<float>(const Scene&, const ProfileOptions&);
template std::vector<ProfileRun> profile_runs<double>(const Scene&, const ProfileOptions&);

}  // namespace packtrace
