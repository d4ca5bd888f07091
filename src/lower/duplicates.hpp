#pragma once

#include <cstddef>

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Removes surfaces that are an earlier one of their kind once more: at equal t the lower number is
/// hit, so they are never seen. Where light passes through objects each
/// counts, and nothing is removed. Returns how many surfaces went.
std::size_t remove_duplicates(LoweredScene& lowered);

}  // namespace packtrace
