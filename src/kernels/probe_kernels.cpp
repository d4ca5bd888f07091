// Before any header of the kernels.
#define PACKTRACE_OBSERVED

#include "kernels/probe_kernels.hpp"

#include "kernels/tile.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

constexpr abi::Features features = abi::feature_sets[abi::probe_set].features;
static_assert(features.probe);

}  // namespace

std::size_t probe_scratch_bytes(const abi::SceneView<float>& scene)
{
    return scratch_bytes<features>(scene);
}

std::size_t probe_scratch_bytes(const abi::SceneView<double>& scene)
{
    return scratch_bytes<features>(scene);
}

abi::RayCounts probe_tile(const abi::TileJob<float>& job)
{
    return render_tile<features>(job);
}

abi::RayCounts probe_tile(const abi::TileJob<double>& job)
{
    return render_tile<features>(job);
}

}  // namespace packtrace::PACKTRACE_ISA
