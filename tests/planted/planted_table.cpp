#include "kernels/stream/tile.hpp"
#include "kernels/table.hpp"

// The kernels with a planted defect that its test runs: packets of floats in the default mode, one
// kernel for every scene and one that records its rays.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <int Set>
constexpr abi::FeatureKernels<float> kernels_of_set(const abi::FeatureSet& known_as)
{
    constexpr abi::Features F = abi::with_exact(abi::feature_sets[Set].features, true);
    return {{known_as.name, abi::with_exact(known_as.features, true)},
            scratch_bytes<F, float>,
            render_tiles<F, float>,
            nullptr};
}

constexpr abi::PrecisionTable<float> floats()
{
    abi::PrecisionTable<float> table;
    table.lanes = lanes<float>;
    for (int set = 0; set < abi::feature_set_count; ++set) {
        table.kernels[set] = set == abi::probe_set
                                 ? kernels_of_set<abi::probe_set>(abi::feature_sets[set])
                                 : kernels_of_set<abi::general_set>(abi::feature_sets[set]);
        table.kernels[abi::feature_set_count + set] = {};
    }
    return table;
}

constexpr abi::KernelTable table = {"planted", floats(), {}, {}};

}  // namespace

const abi::KernelTable& kernel_table()
{
    return table;
}

}  // namespace packtrace::PACKTRACE_ISA
