// Before any header of the kernels.
#define PACKTRACE_OBSERVED

#include "kernels/stream/tile.hpp"
#include "kernels/table.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

constexpr abi::FeatureSet probe = abi::feature_sets[abi::probe_set];
static_assert(probe.features.probe);

constexpr abi::Features exact = abi::with_exact(probe.features, true);
constexpr abi::Features fast = abi::with_exact(probe.features, false);

template <abi::Features F, class Real>
constexpr abi::FeatureKernels<Real> kernels()
{
    return {{probe.name, F}, scratch_bytes<F, Real>, render_tiles<F, Real>, nullptr};
}

constexpr abi::ProbeKernels probes = {kernels<exact, float>(), kernels<fast, float>(),
                                      kernels<fast, double>()};

}  // namespace

const abi::ProbeKernels& probe_kernels()
{
    return probes;
}

}  // namespace packtrace::PACKTRACE_ISA
