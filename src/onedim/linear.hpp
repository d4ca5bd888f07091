#pragma once

#include <packtrace/onedim.hpp>

#include <span>

namespace packtrace::onedim {

/// L0 of the least solution, from the far end in one look-up a surface.
[[nodiscard]] Intensity solve_linear(std::span<const Surface> system);

}  // namespace packtrace::onedim
