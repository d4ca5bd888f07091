#pragma once

#include "scene/source.hpp"

#include <cstddef>

namespace packtrace::reader {

/// The longest scene file and the longest line in one, bytes. Far above any scene of use, and
/// low enough that whatever is handed in by mistake is refused at once.
inline constexpr std::size_t longest_file = std::size_t{1} << 30u;
inline constexpr std::size_t longest_line = std::size_t{1} << 20u;

/// Throws SceneError for what can't be a scene's text: too long, empty or binary.
void check_text(const Source& source);

}  // namespace packtrace::reader
