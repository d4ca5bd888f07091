#pragma once

#include "kernel_abi/kernel_table.hpp"

// The kernels of Features::probe. They have a source of their own because in one object with the
// others they would sway the compiler's choice of what to inline there, and because programs
// without src/study do without them.
namespace packtrace::PACKTRACE_ISA {

/// A reference, which takes no instruction that the machine may lack.
[[nodiscard]] const abi::ProbeKernels& probe_kernels();

}  // namespace packtrace::PACKTRACE_ISA
