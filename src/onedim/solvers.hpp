#pragma once

#include "kernel_abi/onedim_table.hpp"
#include <packtrace/onedim.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The three solvers that solve() chooses from, each in a source of its own.
namespace packtrace::onedim {

/// The rays beside the surfaces, numbered as in the note: segment 0 is at the eye.
struct Rays {
    std::vector<Intensity> left;   ///< L0 … Ln, towards the eye
    std::vector<Intensity> right;  ///< R0 … Rn, away from it
};

/// Fills `rays` with the least solution: from all None, sweeps over the equations raise rays until
/// a sweep changes none. Returns the number of sweeps, at most 4n + 1.
std::size_t iterate(std::span<const Surface> system, Rays& rays);

/// L0 of the least solution, from the far end in one look-up a surface.
[[nodiscard]] Intensity solve_linear(std::span<const Surface> system);

/// The systems' numbers from the shortest to the longest, in words of eight surfaces, equal ones in
/// order: neighbours share a register, and where they are of one length nothing is padding.
[[nodiscard]] std::vector<std::uint32_t> order_by_length(const Systems& systems);

/// Writes L0 of every system to `answers`, a register's bits of systems at a time.
void solve_bitsliced(const Systems& systems, const abi::OnedimTable& kernel,
                     std::span<Intensity> answers);

}  // namespace packtrace::onedim
