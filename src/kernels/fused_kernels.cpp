#include "kernels/fused/fused_tile.hpp"
#include "kernels/table.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F>
constexpr abi::FusedKernels<float> fused_kernels_for()
{
    return {F, plan_bytes<F>, make_plan<F>, fused_scratch_bytes<F>, trace_fused_tiles<F>};
}

constexpr abi::Features spheres{.exact = true};
constexpr abi::Features all_without_glass{.quadrics = true, .colored = true, .exact = true};

#if PACKTRACE_FEATURE_SETS
constexpr abi::FusedKernels<float> fast =
    fused_kernels_for<abi::Features{.quadrics = true, .colored = true}>();
#else
constexpr abi::FusedKernels<float> fast;
#endif

constexpr abi::FusedTable fused = {
    {fused_kernels_for<spheres>(), fused_kernels_for<all_without_glass>(), fast}};

}  // namespace

const abi::FusedTable& fused_kernels()
{
    return fused;
}

}  // namespace packtrace::PACKTRACE_ISA
