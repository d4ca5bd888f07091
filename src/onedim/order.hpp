#pragma once

#include <packtrace/onedim.hpp>

#include <cstdint>
#include <vector>

namespace packtrace::onedim {

/// The systems' numbers from the shortest to the longest, in words of eight surfaces, equal ones in
/// order: neighbours share a register, and where they are of one length nothing is padding.
[[nodiscard]] std::vector<std::uint32_t> order_by_length(const Systems& systems);

}  // namespace packtrace::onedim
