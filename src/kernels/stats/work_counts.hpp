#pragma once

#include "kernel_abi/bvh_view.hpp"
#include "kernels/stats/stage_clock.hpp"

// The hooks that count packets, tests and nodes of a tile, for TileJob::observation.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Records the chunk of rays that is traced next; call it after the stage has begun.
inline void record_chunk(int refracted, int rays)
{
    observer.refracted_share = static_cast<double>(refracted) / rays;
    if (observer.counts != nullptr)
        observer.counts->refracted += static_cast<unsigned>(refracted);
}

/// Records camera rays of a tile in which no object is visible.
inline void record_untraced(std::uint64_t rays)
{
    if (observer.counts != nullptr)
        observer.counts->untraced += rays;
}

/// Counts a packet that does `work` for the lanes of `active`, with the same result in the lanes of
/// `same`.
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

/// Adds one ray to the pixels of the lanes of `active`.
template <class Real>
inline void count_pixels(std::uint32_t active, const vint<Real>& pixel)
{
    alignas(64) lane_int<Real> number[lanes<Real>];
    store(number, pixel);
    for (; active != 0; active &= active - 1)
        ++observer.to->pixels[number[__builtin_ctz(active)]].traced;
}

/// Counts a packet that has found its closest hits.
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

/// Counts a packet that has found which of its shadow rays reach the light; returns those.
template <class Real>
inline std::uint32_t count_lit(std::uint32_t active, std::uint32_t lit)
{
    count_packet<Real>(abi::PacketWork::shadow, active, lit == 0 ? active : lit);
    return lit;
}

/// Records the lanes of the packet that objects are tested against next.
inline void record_live(std::uint32_t active)
{
    observer.live = active;
}

inline abi::TestCounts& tests_of(abi::Primitive kind)
{
    return observer.counts->tests[index(observer.purpose)][index(kind)];
}

/// Counts tests of the packet against `objects` objects of a kind.
inline void count_tests(abi::Primitive kind, int objects)
{
    if (observer.counts == nullptr)
        return;
    tests_of(kind).packets += static_cast<unsigned>(objects);
    tests_of(kind).pairs += popcount(observer.live) * static_cast<unsigned>(objects);
}

/// Counts the tests of one ray against the spheres of a block, side by side.
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

constexpr abi::Step step_of(abi::Primitive kind)
{
    constexpr abi::Step steps[] = {abi::Step::spheres, abi::Step::anchored_spheres,
                                   abi::Step::planes, abi::Step::quadrics, abi::Step::polygons};
    return steps[static_cast<int>(kind)];
}

/// During its lifetime a packet is tested against lists of objects, one kind after another.
class TestScope {
public:
    void test(abi::Primitive kind, int objects = 1) const
    {
        if (objects == 0)
            return;
        step_.next(step_of(kind));
        count_tests(kind, objects);
    }

private:
    StepScope step_{observer.step};
};

/// Counts a node tested against the frustum of several rays.
inline void count_bundle_node()
{
    if (observer.counts != nullptr)
        ++observer.counts->group_nodes[index(observer.purpose)];
}

/// Counts a node tested against one ray.
inline void count_ray_node()
{
    if (observer.counts != nullptr)
        ++observer.counts->ray_nodes[index(observer.purpose)];
}

/// Records the pixels of the rays that are traced next, or of the hits that shadow rays start from;
/// null for camera rays, whose numbers are their pixels.
inline void record_pixels(const lane_int<float>* pixels)
{
    observer.pixels = pixels;
    observer.first = 0;
}
inline void record_pixels(const lane_int<double>*)
{
}

/// Records the number of the current packet's first ray among these.
inline void record_first(int first)
{
    observer.first = first;
}

inline abi::PixelRays& pixel_of(int ray)
{
    return observer.to->pixels[observer.pixels != nullptr ? observer.pixels[ray] : ray];
}

/// Counts the shadow rays that start from the hits of a packet.
inline void count_shadow_pixels(int first, std::uint32_t wanted)
{
    if (!counts_pixels() || observer.pixels == nullptr)
        return;
    for (; wanted != 0; wanted &= wanted - 1)
        ++pixel_of(first + __builtin_ctz(wanted)).traced;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
