#pragma once

#include "kernels/stats/cycle_counter.hpp"
#include "kernels/stats/observer.hpp"

// The hooks that clock the stages of a tile's work, into TileJob::observation.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Gives the time since the last reading to where the tile was at.
[[gnu::noinline]] void take_lap()
{
    Observer& at = observer;
    const std::uint64_t now = at.parts != nullptr ? fenced_ticks() : ticks();
    const std::uint64_t time = now - at.last;
    at.last = now;
    if (at.parts != nullptr) {
        abi::Lap& lap = at.parts->part[index(at.span)][index(at.role)][index(at.part)];
        lap.ticks += time;
        ++lap.reads;
        return;
    }
    at.spans->span[index(at.span)] += time;
    if (at.span == abi::Span::trace)
        at.spans->refracted += at.refracted_share * static_cast<double>(time);
}

inline bool clocked()
{
    return observer.spans != nullptr || observer.parts != nullptr;
}

inline void go_to_generation(int generation)
{
    const abi::Observation& to = *observer.to;
    const int known = generation < to.generations ? generation : to.generations - 1;
    observer.spans = to.spans != nullptr ? to.spans + known : nullptr;
    observer.parts = to.parts != nullptr ? to.parts + known : nullptr;
    observer.counts = to.counts != nullptr ? to.counts + known : nullptr;
}

/// What a reading between parts takes, the least of a few.
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
    if (observer.parts != nullptr)
        observation->reading = time_of_reading();
    observer.last = ticks();
}

inline void end_observation()
{
    if (clocked()) {
        take_lap();
        observer.to->end = observer.last;
    }
    observer = {};
}

/// The next span of a generation begins, with `part`.
inline void begin_span(abi::Span span, int generation, abi::Part part)
{
    if (observer.to == nullptr)
        return;
    if (clocked())
        take_lap();
    go_to_generation(generation);
    observer.span = span;
    observer.part = part;
}

/// Until its end the time goes to a part, or to one after another.
class PartScope {
public:
    explicit PartScope(abi::Part part) : before_(observer.part)
    {
        next(part);
    }
    ~PartScope()
    {
        next(before_);
    }
    PartScope(const PartScope&) = delete;
    PartScope& operator=(const PartScope&) = delete;

    void next(abi::Part part) const
    {
        if (observer.parts == nullptr || part == observer.part)
            return;
        take_lap();
        observer.part = part;
    }

private:
    abi::Part before_;
};

/// Until its end the work is for shadow rays, and begins with `part`.
class ShadowScope {
public:
    explicit ShadowScope(abi::Part part) : before_(observer.part)
    {
        change(abi::Role::shadow, part);
    }
    ~ShadowScope()
    {
        change(abi::Role::own, before_);
    }
    ShadowScope(const ShadowScope&) = delete;
    ShadowScope& operator=(const ShadowScope&) = delete;

private:
    static void change(abi::Role role, abi::Part part)
    {
        if (observer.parts != nullptr)
            take_lap();
        observer.role = role;
        observer.part = part;
    }
    abi::Part before_;
};

/// Until its end unsure rays are traced again; the parts of that count as one.
class RetraceScope {
public:
    RetraceScope() : part_(abi::Part::retrace), parts_(observer.parts)
    {
        observer.parts = nullptr;
    }
    ~RetraceScope()
    {
        observer.parts = parts_;
    }
    RetraceScope(const RetraceScope&) = delete;
    RetraceScope& operator=(const RetraceScope&) = delete;

private:
    PartScope part_;
    abi::PartLaps* parts_;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
