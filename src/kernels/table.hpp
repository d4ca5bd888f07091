#pragma once

#include "kernel_abi/kernel_table.hpp"

// The symbols that the kernels of an instruction set offer to others.
namespace packtrace::PACKTRACE_ISA {

[[nodiscard]] const abi::KernelTable& kernel_table();

/// The kernels of Features::probe. They have a source of their own because in one object with the
/// others they would sway the compiler's choice of what to inline there, and because programs
/// without src/lab do without them.
/// A reference, which takes no instruction that the machine may lack.
[[nodiscard]] const abi::ProbeKernels& probe_kernels();

/// The kernels that trace paths in registers, empty where there are none for sets of features. In a
/// source of their own for the same reasons.
[[nodiscard]] const abi::FusedTable& fused_kernels();

}  // namespace packtrace::PACKTRACE_ISA
