#include "dispatch/kernels.hpp"
#include "lab/profile/observed_frame.hpp"
#include "lab/profile/profile_steps.hpp"
#include "lab/profile/stage_times.hpp"
#include "lab/profile/work_rows.hpp"

#include <algorithm>

namespace packtrace {
namespace {

// Records nothing.
constexpr auto unobserved = [](int) { return nullptr; };

template <class Real>
void time_pieces(ObservedFrame<Real>& frame, PieceTimes& times)
{
    frame.render(unobserved, [&](int piece, double seconds) { times.add(piece, seconds); });
}

// Times plain frames, frames of observing kernels, and frames with the clock, by turns.
template <class Real>
void clock_stages(ObservedFrame<Real>& plain, ObservedFrame<Real>& observed,
                  const ProfileOptions& options, StageTimes& stages, KernelProfile& profile)
{
    const int pieces = observed.pieces();
    PieceTimes plain_times(pieces), observed_times(pieces), clocked_times(pieces);
    // A piece must be clocked twice to find the clock's rate.
    for (int turn = 0; turn < std::max(2, options.repetitions); ++turn) {
        time_pieces(plain, plain_times);
        time_pieces(observed, observed_times);
        observed.render([&](int) { return stages.begin(); },
                        [&](int piece, double seconds) {
                            stages.end(piece);
                            clocked_times.add(piece, seconds);
                        });
    }
    profile.plain = plain_times.frame();
    profile.observed = observed_times.frame();
    profile.clocked = clocked_times.frame();
}

// Renders one frame that clocks the steps of all pieces. Only their shares are used.
template <class Real>
std::vector<KernelStage> divide_stages(ObservedFrame<Real>& observed, const StageTimes& stages,
                                       int generations)
{
    std::vector<abi::StepTicks> steps(static_cast<std::size_t>(generations));
    abi::Observation observation{.generations = generations, .steps = steps.data()};
    StageSeconds seconds(generations);
    observed.render(
        [&](int) {
            std::fill(steps.begin(), steps.end(), abi::StepTicks{});
            return &observation;
        },
        [&](int piece, double) { seconds.add(stages.seconds(piece), steps, observation.reading); });
    return seconds.stages();
}

}  // namespace

LoweredScene observable(LoweredScene lowered)
{
    lowered.features = {
        .quadrics = true, .glass = true, .probe = true, .exact = lowered.features.exact};
    return lowered;
}

template <class Real>
ObservedKernels observe_kernels(const Scene& scene, const ProfileOptions& options)
{
    const RenderOptions sampling = render_options(options);
    const LoweredScene lowered = lower_for<Real>(scene, sampling);
    const auto& table = kernels_of(choose_isa(options.isa).name);
    ObservedFrame<Real> plain(scene, lowered, table, sampling);
    ObservedFrame<Real> observed(scene, observable(lowered), table, sampling);
    const int generations = scene.max_depth + 1;

    ObservedKernels result;
    StageTimes stages(observed.pieces(), generations);
    clock_stages(plain, observed, options, stages, result.profile);
    result.profile.stages = divide_stages(observed, stages, generations);

    result.counts.resize(static_cast<std::size_t>(generations));
    abi::Observation counting{.generations = generations, .counts = result.counts.data()};
    result.rays = observed.render([&](int) { return &counting; }, [](int, double) {});
    result.profile.rays = ray_rows(result.counts, result.profile.stages);
    result.profile.lanes = lane_rows(result.counts);
    result.profile.tests = test_rows(result.counts);
    result.profile.unsure = unsure_rows(result.counts);
    return result;
}

template ObservedKernels observe_kernels<float>(const Scene&, const ProfileOptions&);
template ObservedKernels observe_kernels<double>(const Scene&, const ProfileOptions&);

}  // namespace packtrace
