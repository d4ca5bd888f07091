#pragma once

#include "kernel_abi/bvh.hpp"
#include "kernel_abi/observation.hpp"
#include "kernels/lanes.hpp"

// Hooks throughout the kernels that tell where time and tests go. A source that defines
// PACKTRACE_OBSERVED has those of observer.hpp; for all others they are nothing. They find what to
// record into by themselves: to hand it down would change functions that other kernels run.
#if defined(PACKTRACE_OBSERVED)

#include "kernels/observer.hpp"

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
inline void count_group_node()
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
inline void count_traced(std::uint32_t, const vint<Real>&)
{
}
template <class Real>
inline std::uint32_t count_lit(std::uint32_t, std::uint32_t lit)
{
    return lit;
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
