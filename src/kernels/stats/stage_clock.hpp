#pragma once

#include "kernels/stats/cycle_counter.hpp"
#include "kernels/stats/observer.hpp"

// The hooks that clock the stages of a tile, for TileJob::observation.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Adds the time since the last reading to the current stage or step.
[[gnu::noinline]] void take_ticks()
{
    Observer& at = observer;
    const std::uint64_t now = at.steps != nullptr ? fenced_ticks() : ticks();
    const std::uint64_t time = now - at.last;
    at.last = now;
    if (at.steps != nullptr) {
        abi::Ticks& clocked_step =
            at.steps->step[index(at.stage)][index(at.purpose)][index(at.step)];
        clocked_step.ticks += time;
        ++clocked_step.reads;
        return;
    }
    at.stages->stage[index(at.stage)] += time;
    if (at.stage == abi::Stage::trace)
        at.stages->refracted += at.refracted_share * static_cast<double>(time);
}

inline bool clocked()
{
    return observer.stages != nullptr || observer.steps != nullptr;
}

inline void go_to_generation(int generation)
{
    const abi::Observation& to = *observer.to;
    const int known = generation < to.generations ? generation : to.generations - 1;
    observer.stages = to.stages != nullptr ? to.stages + known : nullptr;
    observer.steps = to.steps != nullptr ? to.steps + known : nullptr;
    observer.counts = to.counts != nullptr ? to.counts + known : nullptr;
}

/// The time that one reading between steps takes: the minimum of a few measurements.
inline std::uint64_t time_of_reading()
{
    std::uint64_t least = ~std::uint64_t{0};
    for (int i = 0; i < 4; ++i) {
        const std::uint64_t from = fenced_ticks();
        const std::uint64_t time = fenced_ticks() - from;
        least = time < least ? time : least;
    }
    return least;
}

inline void begin_observation(abi::Observation* observation)
{
    observer = {};
    if (observation == nullptr)
        return;
    observer.to = observation;
    go_to_generation(0);
    if (!clocked())
        return;
    if (observer.steps != nullptr)
        observation->reading = time_of_reading();
    observer.last = ticks();
}

inline void end_observation()
{
    if (clocked()) {
        take_ticks();
        observer.to->end = observer.last;
    }
    observer = {};
}

/// Starts the next stage of a generation, with `step`.
inline void begin_stage(abi::Stage stage, int generation, abi::Step step)
{
    if (observer.to == nullptr)
        return;
    if (clocked())
        take_ticks();
    go_to_generation(generation);
    observer.stage = stage;
    observer.step = step;
}

/// During its lifetime the time counts for a step; next() changes the step.
class StepScope {
public:
    explicit StepScope(abi::Step step) : before_(observer.step)
    {
        next(step);
    }
    ~StepScope()
    {
        next(before_);
    }
    StepScope(const StepScope&) = delete;
    StepScope& operator=(const StepScope&) = delete;

    void next(abi::Step step) const
    {
        if (observer.steps == nullptr || step == observer.step)
            return;
        take_ticks();
        observer.step = step;
    }

private:
    abi::Step before_;
};

/// During its lifetime the work counts for shadow rays, starting with `step`.
class ShadowScope {
public:
    explicit ShadowScope(abi::Step step) : before_(observer.step)
    {
        change(abi::RayPurpose::shadow, step);
    }
    ~ShadowScope()
    {
        change(abi::RayPurpose::own, before_);
    }
    ShadowScope(const ShadowScope&) = delete;
    ShadowScope& operator=(const ShadowScope&) = delete;

private:
    static void change(abi::RayPurpose purpose, abi::Step step)
    {
        if (observer.steps != nullptr)
            take_ticks();
        observer.purpose = purpose;
        observer.step = step;
    }
    abi::Step before_;
};

/// During its lifetime unsure rays are traced again. All steps of that count as one step.
class RetraceScope {
public:
    RetraceScope() : step_(abi::Step::retrace), steps_(observer.steps)
    {
        observer.steps = nullptr;
    }
    ~RetraceScope()
    {
        observer.steps = steps_;
    }
    RetraceScope(const RetraceScope&) = delete;
    RetraceScope& operator=(const RetraceScope&) = delete;

private:
    StepScope step_;
    abi::StepTicks* steps_;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
