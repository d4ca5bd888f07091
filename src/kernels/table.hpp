#pragma once

#include "kernel_abi/kernel_table.hpp"

// The symbols that the kernels of an instruction set export.
namespace packtrace::PACKTRACE_ISA {

[[nodiscard]] const abi::KernelTable& kernel_table();

/// The kernels of Features::probe. They are compiled in a source of their own, because in one
/// object with the others they would change what the compiler inlines there, and because programs
/// without src/lab do not need them. Returning a reference uses no instruction that the machine may
/// lack.
[[nodiscard]] const abi::ProbeKernels& probe_kernels();

/// The kernels that trace paths in registers. They are in a source of their own for the same
/// reasons.
[[nodiscard]] const abi::FusedTable& fused_kernels();

}  // namespace packtrace::PACKTRACE_ISA
