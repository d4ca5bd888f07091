// Before any header of the kernels.
#define PACKTRACE_OBSERVED

#include "kernels/probe_kernels.hpp"

#include "kernels/tile.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

constexpr abi::FeatureSet probe = abi::feature_sets[abi::probe_set];
static_assert(probe.features.probe);

template <class Real>
constexpr abi::FeatureKernels<Real> kernels()
{
    return {probe, scratch_bytes<probe.features, Real>, render_tile<probe.features, Real>, nullptr};
}

constexpr abi::ProbeKernels both = {kernels<float>(), kernels<double>()};

}  // namespace

const abi::ProbeKernels& probe_kernels()
{
    return both;
}

}  // namespace packtrace::PACKTRACE_ISA
