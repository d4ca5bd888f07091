#pragma once

#include <packtrace/onedim.hpp>

#include <span>
#include <vector>

namespace packtrace::onedim {

/// The rays beside the surfaces, numbered as in the note: segment 0 is at the eye.
struct Rays {
    std::vector<Intensity> left;   ///< L0 … Ln, towards the eye
    std::vector<Intensity> right;  ///< R0 … Rn, away from it
};

/// Fills `rays` with the least solution: from all None, sweeps over the equations raise rays until
/// a sweep changes none. Returns the number of sweeps, at most 4n + 1.
std::size_t iterate(std::span<const Surface> system, Rays& rays);

}  // namespace packtrace::onedim
