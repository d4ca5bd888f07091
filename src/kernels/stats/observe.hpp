#pragma once

#include "kernel_abi/bvh_view.hpp"
#include "kernel_abi/observation.hpp"
#include "kernels/simd/lanes.hpp"

// Hooks throughout the kernels that tell where time and tests go. A source that defines
// PACKTRACE_OBSERVED has those of stage_clock.hpp, work_counts.hpp and unsure_causes.hpp; for all
// others they are nothing. They find what to record into by themselves: to hand it down would
// change functions that other kernels run.
#if defined(PACKTRACE_OBSERVED)

#include "kernels/stats/unsure_causes.hpp"

#else

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Takes what a hook is told, and does nothing.
struct Nothing {
    template <class... Told>
    constexpr void operator()(const Told&...) const
    {
    }
};

inline constexpr Nothing begin_observation;
inline constexpr Nothing end_observation;
inline constexpr Nothing begin_stage;
inline constexpr Nothing tell_chunk;
inline constexpr Nothing tell_untraced;
inline constexpr Nothing tell_live;
inline constexpr Nothing tell_pixels;
inline constexpr Nothing tell_first;
inline constexpr Nothing count_tests;
inline constexpr Nothing count_block_tests;
inline constexpr Nothing count_bundle_node;
inline constexpr Nothing count_ray_node;
inline constexpr Nothing count_shadow_pixels;
inline constexpr Nothing note_rival_of_ray;
inline constexpr Nothing note_in_the_way;
inline constexpr Nothing keep_noted;
inline constexpr Nothing keep_noted_of_ray;
inline constexpr Nothing count_unsure_lanes;
inline constexpr Nothing count_unsure_ray;
inline constexpr Nothing count_unsure_shadows;
inline constexpr Nothing count_unsure_shadow;
inline constexpr Nothing count_undecided;

template <class Real>
inline constexpr Nothing count_packet;
template <class Real>
inline constexpr Nothing count_traced;
template <class Real>
inline constexpr Nothing note_rival;
template <class Real>
inline constexpr Nothing note_doubt;
template <class Real>
inline constexpr Nothing note_magnitude;
template <class Real>
inline constexpr Nothing load_rivals;
template <class Real>
inline constexpr Nothing store_rivals;
template <class Real>
inline constexpr Nothing load_rival_of_ray;
template <class Real>
inline constexpr Nothing store_rival_of_ray;

inline std::int32_t rival_in_doubt(bool)
{
    return 0;
}
inline bool asks_for_undecided()
{
    return false;
}
template <class Real>
inline std::uint32_t count_lit(std::uint32_t, std::uint32_t lit)
{
    return lit;
}
constexpr abi::Step step_of(abi::Primitive)
{
    return {};
}

/// All scopes.
struct NoScope {
    template <class... Told>
    explicit NoScope(const Told&...)
    {
    }
    void next(abi::Step) const
    {
    }
    void test(abi::Primitive, int = 1) const
    {
    }
};
using StepScope = NoScope;
using ShadowScope = NoScope;
using RetraceScope = NoScope;
using TestScope = NoScope;

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA

#endif
