#include "kernels/table.hpp"

#include "kernels/fused/fused_tile.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

constexpr abi::FusedKernels<float> kernels_in_registers()
{
#if PACKTRACE_FEATURE_SETS
    constexpr abi::Features F{.highlights = true, .bounces = true, .exact = true};
    return {F, plan_bytes<F>, make_plan<F>, fused_scratch_bytes<F>, trace_fused_tile<F>};
#else
    return {};
#endif
}

constexpr abi::FusedKernels<float> fused = kernels_in_registers();

}  // namespace

const abi::FusedKernels<float>& fused_kernels()
{
    return fused;
}

}  // namespace packtrace::PACKTRACE_ISA
