#pragma once

#include <packtrace/onedim.hpp>

#include <span>

#include "kernel_abi/onedim_table.hpp"

namespace packtrace::onedim {

/// L0 of every system, a register's bits of them at a time; `answers` is as long as `systems`.
void solve_bitsliced(const Systems& systems, const abi::OnedimTable& kernel,
                     std::span<Intensity> answers);

}  // namespace packtrace::onedim
