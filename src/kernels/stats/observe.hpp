#pragma once

#include "kernel_abi/bvh_view.hpp"
#include "kernel_abi/observation.hpp"
#include "kernels/simd/lanes.hpp"

// Hooks throughout the kernels that record times and counts. A source that defines
// PACKTRACE_OBSERVED gets the hooks of stage_clock.hpp, work_counts.hpp and unsure_causes.hpp; in
// all others the hooks are empty. A hook finds the record of the current tile by itself: a
// parameter for it would change functions that the other kernels use.
#if defined(PACKTRACE_OBSERVED)

#include "kernels/stats/unsure_causes.hpp"

#else

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Accepts the arguments of any hook and does nothing.
struct Nothing {
    template <class... Arguments>
    constexpr void operator()(const Arguments&...) const
    {
    }
};

inline constexpr Nothing begin_observation;
inline constexpr Nothing end_observation;
inline constexpr Nothing begin_stage;
inline constexpr Nothing record_chunk;
inline constexpr Nothing record_untraced;
inline constexpr Nothing record_live;
inline constexpr Nothing record_pixels;
inline constexpr Nothing record_first;
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

/// Stands for every scope class.
struct NoScope {
    template <class... Arguments>
    explicit NoScope(const Arguments&...)
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
