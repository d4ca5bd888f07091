#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernel_abi/observation.hpp"
#include "kernels/simd/simd.hpp"

// What the hooks of observe.hpp know of the tile that a thread is at.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where a thread's tile is at.
struct Observer {
    abi::Observation* to = nullptr;
    abi::StageTicks* stages = nullptr;  ///< of the generation at hand, where they are clocked
    abi::StepTicks* steps = nullptr;    ///< likewise
    abi::WorkCounts* counts = nullptr;  ///< likewise, where it is counted
    std::uint64_t last = 0;             ///< reading of the clock
    abi::Stage stage = abi::Stage::setup;
    abi::RayPurpose purpose = abi::RayPurpose::own;
    abi::Step step = abi::Step::cones;
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

inline bool counts_pixels()
{
    return observer.to != nullptr && observer.to->pixels != nullptr;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
