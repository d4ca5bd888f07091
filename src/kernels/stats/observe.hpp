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

inline void begin_observation(abi::Observation*)
{
}
inline void end_observation()
{
}
inline void begin_span(abi::Span, int, abi::Part)
{
}
inline void tell_chunk(int, int)
{
}
inline void tell_untraced(std::uint64_t)
{
}
inline void tell_live(std::uint32_t)
{
}
inline void count_tests(abi::Primitive, int)
{
}
template <class Real>
inline void count_block_tests(const abi::SphereBlock<Real>&)
{
}
inline void count_bundle_node()
{
}
inline void count_ray_node()
{
}
template <class Real>
inline void count_packet(abi::PacketWork, std::uint32_t, std::uint32_t = 0)
{
}

template <class Real>
inline void count_traced(std::uint32_t, const vint<Real>&, const vint<Real>&)
{
}
template <class Int>
inline void tell_pixels(const Int*)
{
}
inline void tell_first(int)
{
}
inline void count_shadow_pixels(int, std::uint32_t)
{
}
template <class Real>
inline void note_rival(const vmask<Real>&, const vint<Real>&)
{
}
template <class Real>
inline void note_doubt(const vmask<Real>&, std::uint32_t)
{
}
template <class Real>
inline void note_magnitude(const vmask<Real>&)
{
}
inline void note_rival_of_ray(int, std::int32_t)
{
}
inline std::int32_t rival_in_doubt(bool)
{
    return 0;
}
template <class Real>
inline void load_rivals(int)
{
}
template <class Real>
inline void store_rivals(int)
{
}
template <class Real>
inline void load_rival_of_ray(int)
{
}
template <class Real>
inline void store_rival_of_ray(int)
{
}
inline void note_in_the_way(std::uint32_t, abi::Cause)
{
}
inline void keep_noted(int, std::uint32_t)
{
}
inline void keep_noted_of_ray(int, std::uint32_t)
{
}
template <class ObjectOf>
inline void count_unsure_lanes(std::uint32_t, const lane_int<float>*, const ObjectOf&)
{
}
template <class ObjectOf>
inline void count_unsure_ray(int, std::int32_t, const ObjectOf&)
{
}
inline void count_unsure_shadows(std::uint32_t)
{
}
inline void count_unsure_shadow(int)
{
}
inline bool asks_for_undecided()
{
    return false;
}
inline void count_undecided(int)
{
}
template <class Real>
inline std::uint32_t count_lit(std::uint32_t, std::uint32_t lit)
{
    return lit;
}

constexpr abi::Part part_of(abi::Primitive)
{
    return {};
}

struct PartScope {
    explicit PartScope(abi::Part)
    {
    }
    void next(abi::Part) const
    {
    }
};

struct ShadowScope {
    explicit ShadowScope(abi::Part)
    {
    }
};

struct RetraceScope {
    RetraceScope()
    {
    }
};

struct TestScope {
    TestScope()
    {
    }
    void test(abi::Primitive, int = 1) const
    {
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA

#endif
