// Before any header of the kernels.
#define PACKTRACE_OBSERVED

#include "kernels/stream/tile.hpp"
#include "kernels/table.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

constexpr abi::FeatureSet probe = abi::feature_sets[abi::probe_set];
static_assert(probe.features.probe);

template <bool Exact, class Real>
constexpr abi::FeatureKernels<Real> kernels()
{
    constexpr abi::Features F = abi::with_exact(probe.features, Exact);
    return {{probe.name, F}, scratch_bytes<F, Real>, render_tiles<F, Real>, nullptr};
}

constexpr abi::ProbeKernels probes = {kernels<true, float>(), kernels<false, float>(),
                                      kernels<false, double>()};

}  // namespace

const abi::ProbeKernels& probe_kernels()
{
    return probes;
}

}  // namespace packtrace::PACKTRACE_ISA
