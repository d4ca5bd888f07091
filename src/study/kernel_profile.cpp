#include "study/kernel_profile.hpp"

#include <algorithm>
#include <chrono>

#include "dispatch/kernels.hpp"
#include "study/observed_frame.hpp"
#include "study/profile_subjects.hpp"
#include "study/span_times.hpp"
#include "study/stage_seconds.hpp"
#include "study/statistics.hpp"
#include "study/work_rows.hpp"

namespace packtrace {
namespace {

// A frame has the clock in one piece in so many, and so many frames clock each piece once: where
// pieces are short, the dozens of readings in one are not little beside it.
int stride_for(double frame, int pieces)
{
    constexpr double short_piece = 20e-6;
    return frame / pieces < short_piece ? 8 : 1;
}

// Frames of each kind; the clock's rate is told by a piece that is clocked twice.
int frames_for(const ProfileOptions& options, int stride)
{
    return std::max(2, stride > 1 ? (options.repetitions + 2) / 3 : options.repetitions) * stride;
}

template <class Real>
double seconds_of(ObservedFrame<Real>& frame)
{
    const auto start = std::chrono::steady_clock::now();
    frame.render();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Plain frames, observable ones, and those with the clock in some pieces, in turns.
template <class Real>
void clock_spans(ObservedFrame<Real>& plain, ObservedFrame<Real>& observed,
                 const ProfileOptions& options, SpanTimes& spans, KernelProfile& profile)
{
    const int stride = stride_for(seconds_of(observed), observed.pieces());
    int phase = 0;
    const auto clocked = [&](int piece) { return (piece + phase) % stride == 0; };
    std::vector<ProfileRun> runs{
        {"plain", [&] { return plain.render(); }, {}, {}},
        {"observed", [&] { return observed.render(); }, {}, {}},
        {"clocked", [&] {
             ++phase;
             return observed.render(
                 [&](int piece) { return clocked(piece) ? spans.begin() : nullptr; },
                 [&](int piece) {
                     if (clocked(piece))
                         spans.end(piece);
                 });
         }, {}, {}}};
    take_times(runs, frames_for(options, stride));
    profile.stride = stride;
    profile.plain = median_of(runs[0].seconds);
    profile.observed = median_of(runs[1].seconds);
    profile.clocked = median_of(runs[2].seconds);
    profile.clock = median_difference(runs[2].seconds, runs[1].seconds);
}

// One frame that clocks the parts of all pieces, for their shares alone.
template <class Real>
std::vector<KernelStage> divide_spans(ObservedFrame<Real>& observed, const SpanTimes& spans,
                                      int generations)
{
    std::vector<abi::PartLaps> parts(static_cast<std::size_t>(generations));
    abi::Observation observation;
    observation.generations = generations;
    observation.parts = parts.data();
    StageSeconds seconds(generations);
    observed.render(
        [&](int) {
            std::fill(parts.begin(), parts.end(), abi::PartLaps{});
            return &observation;
        },
        [&](int piece) { seconds.add(spans.seconds(piece), parts, observation.reading); });
    return seconds.stages();
}

}  // namespace

LoweredScene observable(LoweredScene lowered)
{
    lowered.features = {.quadrics = true, .glass = true, .probe = true};
    return lowered;
}

template <class Real>
ObservedKernels observe_kernels(const Scene& scene, const ProfileOptions& options)
{
    const RenderOptions sampling = render_options(options);
    const LoweredScene lowered = lower(scene, accuracy_in<Real>(sampling));
    const auto& table = kernels_of(choose_isa(options.isa).name);
    ObservedFrame<Real> plain(scene, lowered, table, sampling);
    ObservedFrame<Real> observed(scene, observable(lowered), table, sampling);
    const int generations = scene.max_depth + 1;

    ObservedKernels result;
    SpanTimes spans(observed.pieces(), generations);
    clock_spans(plain, observed, options, spans, result.profile);
    result.profile.stages = divide_spans(observed, spans, generations);

    result.counts.resize(static_cast<std::size_t>(generations));
    abi::Observation counting;
    counting.generations = generations;
    counting.counts = result.counts.data();
    result.rays = observed.render([&](int) { return &counting; }, [](int) {});
    result.profile.rays = ray_rows(result.counts, result.profile.stages);
    result.profile.lanes = lane_rows(result.counts);
    result.profile.tests = test_rows(result.counts);
    return result;
}

template ObservedKernels observe_kernels<float>(const Scene&, const ProfileOptions&);
template ObservedKernels observe_kernels<double>(const Scene&, const ProfileOptions&);

}  // namespace packtrace
