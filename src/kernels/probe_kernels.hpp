#pragma once

#include "kernel_abi/kernel_table.hpp"

// The kernels of Features::probe. They have a source of their own because in one object with the
// others they would sway the compiler's choice of what to inline there.
namespace packtrace::PACKTRACE_ISA {

[[nodiscard]] std::size_t probe_scratch_bytes(const abi::SceneView<float>& scene);
[[nodiscard]] std::size_t probe_scratch_bytes(const abi::SceneView<double>& scene);
[[nodiscard]] abi::RayCounts probe_tile(const abi::TileJob<float>& job);
[[nodiscard]] abi::RayCounts probe_tile(const abi::TileJob<double>& job);

}  // namespace packtrace::PACKTRACE_ISA
