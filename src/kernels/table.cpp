#include "kernels/table.hpp"

#include "kernels/simd/self_test.hpp"
#include "kernels/stream/closest_rays.hpp"
#include "kernels/stream/closest_tile.hpp"
#include "kernels/stream/crossing_rays.hpp"
#include "kernels/stream/lit_points.hpp"
#include "kernels/stream/occluded_rays.hpp"
#include "kernels/stream/tile.hpp"
#include "onedim/onedim_kernel.hpp"

#include <utility>

namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
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
        store(out, highlight_power<Real>(load(in[0]), load(in[1])));
        for (int lane = 0; lane < live; ++lane)
            y[first + lane] = out[lane];
    }
}

/// Whether hits are decided with error bounds (Features::exact).
enum class Mode { exact, fast };

/// Feature sets are compiled for exact mode with floats. Fast mode and double, which renders
/// reference pictures, have only the general set. Probes are compiled in probe_kernels.cpp.
template <class Real>
constexpr bool is_compiled(int set, Mode mode)
{
    const bool exact = mode == Mode::exact;
    if (set == abi::probe_set || (exact && sizeof(Real) != sizeof(float)))
        return false;
    return (PACKTRACE_FEATURE_SETS && exact) || set == abi::general_set;
}

template <int Set, Mode M, class Real>
constexpr abi::FeatureKernels<Real> feature_kernels()
{
    constexpr abi::Features F = abi::with_exact(abi::feature_sets[Set].features, M == Mode::exact);
    constexpr abi::FeatureSet set{abi::feature_sets[Set].name, F};
    if constexpr (!is_compiled<Real>(Set, M))
        return {};
    else
        return {set, scratch_bytes<F, Real>, render_tiles<F, Real>,
                closest_tile<abi::tree_features(F), Real>};
}

template <class Real, int... Set>
constexpr void set_feature_kernels(abi::PrecisionTable<Real>& table,
                                   std::integer_sequence<int, Set...>)
{
    ((table.kernels[Set] = feature_kernels<Set, Mode::exact, Real>()), ...);
    ((table.kernels[abi::feature_set_count + Set] = feature_kernels<Set, Mode::fast, Real>()), ...);
}

/// The features for rays from the caller, in the mode that the scene was made for.
inline constexpr abi::Features exact_surfaces{.quadrics = true, .exact = true};
inline constexpr abi::Features fast_surfaces{.quadrics = true};

/// Returns `call.template operator()<F>()` with the features of the mode that a scene was made for.
template <class Real, class Call>
inline auto with_surfaces(const abi::SceneView<Real>& scene, const Call& call)
{
    if constexpr (sizeof(Real) == sizeof(float))
        if (scene.wide != nullptr)
            return call.template operator()<exact_surfaces>();
    return call.template operator()<fast_surfaces>();
}

template <class Real>
std::size_t any_stream_bytes(const abi::SceneView<Real>& scene)
{
    return with_surfaces(
        scene, [&]<abi::Features F>() { return StreamWork<F, Real>(nullptr, scene).bytes; });
}

template <class Real>
void any_closest_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& rays,
                      const abi::HitsView<Real>& hits, void* scratch)
{
    with_surfaces(scene, [&]<abi::Features F>() { closest_hits<F>(scene, rays, hits, scratch); });
}

template <class Real>
void any_occluded(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& rays,
                  std::uint8_t* mask, void* scratch)
{
    with_surfaces(scene, [&]<abi::Features F>() { occluded_rays<F>(scene, rays, mask, scratch); });
}

template <class Real>
std::size_t any_lit_bytes(const abi::SceneView<Real>& scene)
{
    const abi::SceneView<Real>& casters = casters_of(scene);
    return with_surfaces(
        scene, [&]<abi::Features F>() { return LitWork<F, Real>(nullptr, casters).bytes; });
}

template <class Real>
void any_lit(const abi::SceneView<Real>& scene, const abi::PointsView<Real>& points,
             const abi::LightRecord<Real>& light, const abi::LightBuffer* buffer,
             std::uint8_t* mask, void* scratch)
{
    with_surfaces(scene, [&]<abi::Features F>() {
        lit_points<F>(scene, points, light, buffer, mask, scratch);
    });
}

template <class Real>
void any_all_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& rays,
                  const abi::HitSink<Real>& sink)
{
    with_surfaces(scene, [&]<abi::Features F>() { all_hits<F>(scene, rays, sink); });
}

template <class Real>
constexpr abi::PrecisionTable<Real> precision_table()
{
    abi::PrecisionTable<Real> table;
    table.lanes = lanes<Real>;
    set_feature_kernels(table, std::make_integer_sequence<int, abi::feature_set_count>());
    table.stream_scratch_bytes = any_stream_bytes<Real>;
    table.closest_hits = any_closest_hits<Real>;
    table.occluded = any_occluded<Real>;
    table.lit_scratch_bytes = any_lit_bytes<Real>;
    table.lit = any_lit<Real>;
    table.all_hits = any_all_hits<Real>;
    table.highlight_power = power_of_arrays<Real>;
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
