#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernel_abi/observation.hpp"
#include "kernels/simd/simd.hpp"

// The state of the hooks of observe.hpp: what a thread knows of its current tile.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The state of a thread's current tile.
struct Observer {
    abi::Observation* to = nullptr;
    /// Of the current generation; null if stages are not clocked.
    abi::StageTicks* stages = nullptr;
    abi::StepTicks* steps = nullptr;  ///< of the current generation; null if steps are not clocked
    abi::WorkCounts* counts = nullptr;  ///< of the current generation; null if nothing is counted
    std::uint64_t last = 0;             ///< last reading of the clock
    abi::Stage stage = abi::Stage::setup;
    abi::RayPurpose purpose = abi::RayPurpose::own;
    abi::Step step = abi::Step::cones;
    std::uint32_t live = 0;      ///< lanes with rays in the packet that objects are tested against
    double refracted_share = 0;  ///< share of refracted rays in the chunk that is traced
    /// Pixels of the current rays; null: each ray's number is its pixel.
    const std::int32_t* pixels = nullptr;
    int first = 0;  ///< number of the current packet's first ray among these
    // Why a ray is unsure, by lane of the packet and by ray of the bundle. For closest hits: the
    // surface that may be hit first instead, or -1 for the end of the range, or a cause (see
    // rival_for()). For shadow rays: a cause.
    std::int32_t rival[16] = {};
    std::int32_t rival_of_ray[abi::tile_pixels] = {};
    abi::Cause noted[16] = {};
    /// Lanes of the packet whose magnitudes the error bounds do not hold for.
    std::uint32_t beyond = 0;
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
