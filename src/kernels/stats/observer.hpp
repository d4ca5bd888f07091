#pragma once

#include "kernel_abi/bvh_view.hpp"
#include "kernel_abi/kernel_table.hpp"
#include "kernel_abi/observation.hpp"
#include "kernels/simd/simd.hpp"
#include "kernels/stats/cycle_counter.hpp"

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
    std::uint32_t live = 0;                ///< rays in the packet that objects are tested against
    double refracted_share = 0;            ///< of the chunk that is traced
    const std::int32_t* pixels = nullptr;  ///< of the rays at hand; null: their own numbers
    int first = 0;                         ///< number of the packet's first ray among them
    // What an unsure ray's doubt comes from, by lane of the packet and by ray of the bundle: for
    // closest hits a surface, -1 for the range's end, or below that a cause; for shadows a cause.
    std::int32_t rival[16] = {};
    std::int32_t rival_of_ray[abi::tile_pixels] = {};
    abi::Cause noted[16] = {};
    std::uint32_t beyond = 0;  ///< lanes of the packet that no bound holds for
    abi::Cause noted_of_ray[abi::tile_pixels] = {};
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

inline bool counts_pixels()
{
    return observer.to != nullptr && observer.to->pixels != nullptr;
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

/// Adds to what is counted of the pixels of the lanes of `active`.
template <class Real>
inline void count_pixels(std::uint32_t active, const vint<Real>& pixel)
{
    alignas(64) lane_int<Real> number[lanes<Real>];
    store(number, pixel);
    for (; active != 0; active &= active - 1)
        ++observer.to->pixels[number[__builtin_ctz(active)]].traced;
}

/// A packet found which surfaces its rays meet.
template <class Real>
inline void count_traced(std::uint32_t active, const vint<Real>& surface, const vint<Real>& pixel)
{
    if (counts_pixels())
        count_pixels<Real>(active, pixel);
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
                                   abi::Part::planes, abi::Part::quadrics, abi::Part::polygons};
    return parts[static_cast<int>(kind)];
}

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

/// A node is met by the frustum of several rays.
inline void count_bundle_node()
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

/// The pixels of the rays that are traced next, or of the hits that shadow rays start from; null
/// for camera rays, each of which has its pixel's number.
inline void tell_pixels(const lane_int<float>* pixels)
{
    observer.pixels = pixels;
    observer.first = 0;
}
inline void tell_pixels(const lane_int<double>*)
{
}

/// The number among them of the first ray of the packet at hand.
inline void tell_first(int first)
{
    observer.first = first;
}

inline abi::PixelRays& pixel_of(int ray)
{
    return observer.to->pixels[observer.pixels != nullptr ? observer.pixels[ray] : ray];
}

/// Shadow rays start from the hits of a packet.
inline void count_shadow_pixels(int first, std::uint32_t wanted)
{
    if (!counts_pixels() || observer.pixels == nullptr)
        return;
    for (; wanted != 0; wanted &= wanted - 1)
        ++pixel_of(first + __builtin_ctz(wanted)).traced;
}

inline bool names_causes()
{
    return observer.counts != nullptr;
}

constexpr std::int32_t rival_for(abi::Cause cause)
{
    return -2 - static_cast<std::int32_t>(cause);
}

/// The surface `number` may come before what the lanes of `lowered` hit; -1 is the range's end.
template <class Real>
inline void note_rival(const vmask<Real>& lowered, const vint<Real>& number)
{
    if (!names_causes())
        return;
    alignas(64) std::int32_t numbers[lanes<float>];
    store(numbers, number);
    for (std::uint32_t left = bits(lowered); left != 0; left &= left - 1)
        observer.rival[__builtin_ctz(left)] = numbers[__builtin_ctz(left)];
}

/// Something may come before it: of the lanes of `at_end` a hit that may be before t_min, of the
/// others one that may not be.
template <class Real>
inline void note_doubt(const vmask<Real>& lowered, std::uint32_t at_end)
{
    note_rival<Real>(lowered, select(from_bits<Real>(at_end & all_lanes<Real>),
                                     vint<Real>(rival_for(abi::Cause::range)),
                                     vint<Real>(rival_for(abi::Cause::tangent))));
}

/// Nothing is known of the lanes.
template <class Real>
inline void note_magnitude(const vmask<Real>& lowered)
{
    note_rival<Real>(lowered, vint<Real>(rival_for(abi::Cause::magnitude)));
}

/// The same of one ray of a bundle.
inline void note_rival_of_ray(int ray, std::int32_t number)
{
    observer.rival_of_ray[ray] = number;
}
/// What note_doubt() has of a hit that may be before t_min, or may not be.
inline std::int32_t rival_in_doubt(bool at_end)
{
    return rival_for(at_end ? abi::Cause::range : abi::Cause::tangent);
}

/// A packet of a bundle is taken up, or put back. What doubles have is never in doubt.
template <class Real>
inline void load_rivals(int first)
{
    if constexpr (sizeof(Real) == sizeof(float))
        for (int lane = 0; lane < lanes<float> && names_causes(); ++lane)
            observer.rival[lane] = observer.rival_of_ray[first + lane];
}
template <class Real>
inline void store_rivals(int first)
{
    if constexpr (sizeof(Real) == sizeof(float))
        for (int lane = 0; lane < lanes<float> && names_causes(); ++lane)
            observer.rival_of_ray[first + lane] = observer.rival[lane];
}

/// One ray of a bundle is taken up as a packet, or put back.
template <class Real>
inline void load_rival_of_ray(int ray)
{
    if constexpr (sizeof(Real) == sizeof(float))
        for (int lane = 0; lane < lanes<float>; ++lane)
            observer.rival[lane] = observer.rival_of_ray[ray];
}
template <class Real>
inline void store_rival_of_ray(int ray)
{
    if constexpr (sizeof(Real) == sizeof(float))
        observer.rival_of_ray[ray] = observer.rival[0];
}

/// Something may be in the way of the lanes of `unsure`. Those that no bound holds for are told of
/// before all others of a packet, and keep that cause.
inline void note_in_the_way(std::uint32_t unsure, abi::Cause cause)
{
    if (cause == abi::Cause::magnitude)
        observer.beyond = unsure;
    else
        unsure &= ~observer.beyond;
    for (; unsure != 0; unsure &= unsure - 1)
        observer.noted[__builtin_ctz(unsure)] = cause;
}

/// What was noted of lanes is so of the rays of the packet at `first` of a bundle.
inline void keep_noted(int first, std::uint32_t unsure)
{
    observer.beyond = 0;
    for (; unsure != 0; unsure &= unsure - 1)
        observer.noted_of_ray[first + __builtin_ctz(unsure)] =
            observer.noted[__builtin_ctz(unsure)];
}

/// What was noted of any lane of `unsure` is so of one ray of a bundle.
inline void keep_noted_of_ray(int ray, std::uint32_t unsure)
{
    observer.noted_of_ray[ray] = observer.noted[__builtin_ctz(unsure)];
}

inline void count_unsure(abi::Cause cause, int ray)
{
    if (observer.counts != nullptr)
        ++observer.counts->unsure[index(observer.role)][index(cause)];
    if (counts_pixels())
        ++pixel_of(ray).unsure;
}

/// Why nothing tells which of two comes first; `object_of(surface)` is a surface's object.
template <class ObjectOf>
inline abi::Cause cause_of(std::int32_t surface, std::int32_t rival, const ObjectOf& object_of)
{
    if (rival < -1)
        return static_cast<abi::Cause>(-2 - rival);
    if (rival < 0 || surface < 0)
        return abi::Cause::range;
    if (rival == surface)
        return abi::Cause::tangent;
    return object_of(rival) == object_of(surface) ? abi::Cause::clip : abi::Cause::order;
}

/// Lanes of the packet are unsure of their closest hits, which are so far on `surface`.
template <class ObjectOf>
inline void count_unsure_lanes(std::uint32_t unsure, const lane_int<float>* surface,
                               const ObjectOf& object_of)
{
    if (observer.to == nullptr)
        return;
    for (; unsure != 0; unsure &= unsure - 1) {
        const int lane = __builtin_ctz(unsure);
        const abi::Cause cause = names_causes()
                                     ? cause_of(surface[lane], observer.rival[lane], object_of)
                                     : abi::Cause::order;
        count_unsure(cause, observer.first + lane);
    }
}

/// The same of a ray of a bundle.
template <class ObjectOf>
inline void count_unsure_ray(int ray, std::int32_t surface, const ObjectOf& object_of)
{
    if (observer.to == nullptr)
        return;
    const abi::Cause cause = names_causes()
                                 ? cause_of(surface, observer.rival_of_ray[ray], object_of)
                                 : abi::Cause::order;
    count_unsure(cause, ray);
}

/// Shadow rays of a packet, or of a bundle, are unsure of what is in their way.
inline void count_unsure_shadows(std::uint32_t unsure)
{
    if (observer.to != nullptr)
        for (; unsure != 0; unsure &= unsure - 1)
            count_unsure(observer.noted[__builtin_ctz(unsure)],
                         observer.first + __builtin_ctz(unsure));
}
inline void count_unsure_shadow(int ray)
{
    if (observer.to != nullptr)
        count_unsure(observer.noted_of_ray[ray], ray);
}

inline bool asks_for_undecided()
{
    return counts_pixels();
}

/// Double cannot decide about an unsure ray either.
inline void count_undecided(int ray)
{
    ++pixel_of(observer.first + ray).undecided;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
