#pragma once

#include "lower/lowered_scene.hpp"

namespace packtrace {

/// Marks the surfaces that rays in single precision shall be tested against in double.
void mark_stiff(Accuracy accuracy, LoweredScene& lowered);

}  // namespace packtrace
