#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Marks the surfaces that rays in single precision shall be tested against in double.
void mark_stiff(Accuracy accuracy, LoweredScene& lowered);

/// How many surfaces are marked.
[[nodiscard]] std::size_t count_stiff(const LoweredScene& lowered);

/// Marks the surfaces whose hits shall be solved again in double: all of them in robust mode, in
/// automatic mode those whose normals need it; there other quadrics' hits are sharpened, and where
/// rays start from the exact place all others too.
void mark_finished(Accuracy accuracy, SelfHits self_hits, LoweredScene& lowered);

}  // namespace packtrace
