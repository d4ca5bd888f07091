#pragma once

#include "kernel_abi/onedim_table.hpp"
#include <packtrace/onedim.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The three solvers that solve() chooses from, each in its own source file.
namespace packtrace::onedim {

/// The rays of the segments between surfaces, numbered as in the note: segment 0 is at the eye.
struct Rays {
    std::vector<Intensity> left;   ///< L0 … Ln, towards the eye
    std::vector<Intensity> right;  ///< R0 … Rn, away from it
};

/// Fills `rays` with the least solution: from all None, sweeps over the equations raise rays until
/// a sweep changes none. Returns the number of sweeps, at most 4n + 1.
std::size_t iterate(std::span<const Surface> system, Rays& rays);

/// L0 of the least solution: one look-up for each surface, from the far end.
[[nodiscard]] Intensity solve_linear(std::span<const Surface> system);

/// The systems' numbers, sorted by length in words of eight surfaces; equal lengths keep their
/// order. Neighbours share a register, and need no padding if their lengths are equal.
[[nodiscard]] std::vector<std::uint32_t> order_by_length(const Systems& systems);

/// Writes L0 of every system to `answers`, as many systems at a time as a register has bits.
void solve_bitsliced(const Systems& systems, const abi::OnedimTable& kernel,
                     std::span<Intensity> answers);

}  // namespace packtrace::onedim
