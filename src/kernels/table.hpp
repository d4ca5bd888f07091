#pragma once

#include "kernel_abi/kernel_table.hpp"

// The one symbol that the kernels of an instruction set offer to others.
namespace packtrace::PACKTRACE_ISA {

[[nodiscard]] const abi::KernelTable& kernel_table();

}  // namespace packtrace::PACKTRACE_ISA
