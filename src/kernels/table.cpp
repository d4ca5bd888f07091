#include "kernels/table.hpp"

#include <utility>

#include "kernels/closest_tile.hpp"
#include "kernels/onedim.hpp"
#include "kernels/ray_streams.hpp"
#include "kernels/self_test.hpp"
#include "kernels/tile.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Which of the highlights' powers: that of scenes in general, or of those with precise_powers.
enum class Power { usual, precise };

template <Power P>
inline vreal<float> power_of(const vreal<float>& x, const vreal<float>& n)
{
    return P == Power::precise ? precise_power(x, n) : highlight_power<float>(x, n);
}
template <Power P>
inline vreal<double> power_of(const vreal<double>& x, const vreal<double>& n)
{
    return highlight_power<double>(x, n);
}

template <class Real, Power P>
void power_of_arrays(const Real* x, const Real* n, Real* y, int count)
{
    alignas(64) Real in[2][lanes<Real>] = {};
    alignas(64) Real out[lanes<Real>];
    for (int first = 0; first < count; first += lanes<Real>) {
        const int live = count - first < lanes<Real> ? count - first : lanes<Real>;
        for (int lane = 0; lane < live; ++lane) {
            in[0][lane] = x[first + lane];
            in[1][lane] = n[first + lane];
        }
        store(out, power_of<P>(load(in[0]), load(in[1])));
        for (int lane = 0; lane < live; ++lane)
            y[first + lane] = out[lane];
    }
}

/// Double renders truths to compare with, and does without special kernels. Probes are compiled
/// in probe_kernels.cpp.
template <class Real>
constexpr bool is_compiled(int set)
{
    return set != abi::probe_set &&
           ((PACKTRACE_FEATURE_SETS && sizeof(Real) == sizeof(float)) || set == abi::general_set);
}

template <int Set, class Real>
constexpr abi::FeatureKernels<Real> feature_kernels()
{
    constexpr abi::FeatureSet set = abi::feature_sets[Set];
    constexpr abi::Features F = set.features;
    if constexpr (!is_compiled<Real>(Set))
        return {};
    else
        return {set, scratch_bytes<F, Real>, render_tile<F, Real>,
                closest_tile<abi::tree_features(F), Real>};
}

template <class Real, int... Set>
constexpr void set_feature_kernels(abi::PrecisionTable<Real>& table,
                                   std::integer_sequence<int, Set...>)
{
    ((table.kernels[Set] = feature_kernels<Set, Real>()), ...);
}

template <class Real>
constexpr abi::PrecisionTable<Real> precision_table()
{
    abi::PrecisionTable<Real> table;
    table.lanes = lanes<Real>;
    set_feature_kernels(table, std::make_integer_sequence<int, abi::feature_set_count>());
    constexpr abi::Features any_surface{.quadrics = true};
    table.closest_hits = closest_hits<any_surface, Real>;
    table.occluded = occluded_rays<any_surface, Real>;
    table.all_hits = all_hits<any_surface, Real>;
    table.highlight_power = power_of_arrays<Real, Power::usual>;
    table.precise_power = power_of_arrays<Real, Power::precise>;
    table.self_test = self_test<Real>;
    return table;
}

#define PACKTRACE_TEXT_OF(name) #name
#define PACKTRACE_TEXT(name) PACKTRACE_TEXT_OF(name)

constexpr abi::KernelTable table = {PACKTRACE_TEXT(PACKTRACE_ISA), precision_table<float>(),
                                    precision_table<double>(), onedim::table};

}  // namespace

const abi::KernelTable& kernel_table()
{
    return table;
}

}  // namespace packtrace::PACKTRACE_ISA
