#pragma once

#include "kernel_abi/kernel_table.hpp"

// The one symbol a kernel object offers.
namespace packtrace::PACKTRACE_ISA {

[[nodiscard]] const abi::KernelTable& kernel_table();

}  // namespace packtrace::PACKTRACE_ISA
