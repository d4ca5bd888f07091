#pragma once

#include "kernel_abi/bvh.hpp"
#include "kernel_abi/observation.hpp"
#include "kernels/native/cycle_counter.hpp"
#include "kernels/simd.hpp"

// What the hooks of observe.hpp do where they do anything: the stages of a tile's work are clocked
// and counted into TileJob::observation.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where a thread's tile is at.
struct Observer {
    abi::Observation* to = nullptr;
    abi::SpanLaps* spans = nullptr;     ///< of the generation at hand, where they are clocked
    abi::PartLaps* parts = nullptr;     ///< likewise
    abi::WorkCounts* counts = nullptr;  ///< likewise, where it is counted
    std::uint64_t last = 0;             ///< reading of the clock
    abi::Span span = abi::Span::setup;
    abi::Role role = abi::Role::own;
    abi::Part part = abi::Part::beams;
    std::uint32_t live = 0;      ///< rays in the packet that objects are tested against
    double refracted_share = 0;  ///< of the chunk that is traced
};

thread_local Observer observer;

template <class Index>
inline int index(Index at)
{
    return static_cast<int>(at);
}

inline std::uint64_t popcount(std::uint32_t bits)
{
    return static_cast<unsigned>(__builtin_popcount(bits));
}

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

/// The rays that are traced next, after their span began.
inline void tell_chunk(int refracted, int rays)
{
    observer.refracted_share = static_cast<double>(refracted) / rays;
    if (observer.counts != nullptr)
        observer.counts->refracted += static_cast<unsigned>(refracted);
}

/// Camera rays of a tile that can meet nothing.
inline void tell_untraced(std::uint64_t rays)
{
    if (observer.counts != nullptr)
        observer.counts->untraced += rays;
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

/// A packet does `work` for the lanes of `active`, with the same result in those of `same`.
template <class Real>
inline void count_packet(abi::PacketWork work, std::uint32_t active, std::uint32_t same = 0)
{
    if (observer.counts == nullptr || active == 0)
        return;
    abi::PacketCounts& packets = observer.counts->work[index(work)];
    ++packets.packets;
    packets.live += popcount(active);
    packets.coherent += (active & same) == all_lanes<Real> ? 1 : 0;
}

/// A packet found which surfaces its rays meet.
template <class Real>
inline void count_traced(std::uint32_t active, const vint<Real>& surface)
{
    if (observer.counts == nullptr)
        return;
    alignas(64) lane_int<Real> number[lanes<Real>];
    store(number, surface);
    std::uint32_t same = 0;
    for (int lane = 0; lane < lanes<Real>; ++lane)
        same |= number[lane] == number[0] ? 1u << lane : 0;
    count_packet<Real>(abi::PacketWork::trace, active, same);
}

/// A packet found which of its shadow rays reach the light, which are returned.
template <class Real>
inline std::uint32_t count_lit(std::uint32_t active, std::uint32_t lit)
{
    count_packet<Real>(abi::PacketWork::shadow, active, lit == 0 ? active : lit);
    return lit;
}

/// Objects will be tested against a packet with rays in these lanes.
inline void tell_live(std::uint32_t active)
{
    observer.live = active;
}

inline abi::TestCounts& tests_of(abi::Primitive kind)
{
    return observer.counts->tests[index(observer.role)][index(kind)];
}

/// The packet is tested against `objects` of a kind.
inline void count_tests(abi::Primitive kind, int objects)
{
    if (observer.counts == nullptr)
        return;
    tests_of(kind).packets += static_cast<unsigned>(objects);
    tests_of(kind).pairs += popcount(observer.live) * static_cast<unsigned>(objects);
}

/// One ray is tested against the spheres of a block side by side.
template <class Real>
inline void count_block_tests(const abi::SphereBlock<Real>& block)
{
    if (observer.counts == nullptr)
        return;
    constexpr int packets = lanes<Real> < abi::node_width ? abi::node_width / lanes<Real> : 1;
    tests_of(abi::Primitive::sphere).packets += packets;
    for (const Real radius : block.radius)
        tests_of(abi::Primitive::sphere).pairs += radius >= 0 ? 1 : 0;
}

constexpr abi::Part part_of(abi::Primitive kind)
{
    constexpr abi::Part parts[] = {abi::Part::spheres, abi::Part::anchored_spheres,
                                   abi::Part::planes, abi::Part::quadrics};
    return parts[static_cast<int>(kind)];
}

/// Until its end a packet is tested against lists of objects, one kind after another.
class TestScope {
public:
    void test(abi::Primitive kind, int objects = 1) const
    {
        if (objects == 0)
            return;
        part_.next(part_of(kind));
        count_tests(kind, objects);
    }

private:
    PartScope part_{observer.part};
};

/// A node is met by the beam of several rays.
inline void count_group_node()
{
    if (observer.counts != nullptr)
        ++observer.counts->group_nodes[index(observer.role)];
}

/// A node is met by one ray.
inline void count_ray_node()
{
    if (observer.counts != nullptr)
        ++observer.counts->ray_nodes[index(observer.role)];
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
