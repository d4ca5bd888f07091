#pragma once

#include "scene/block.hpp"
#include "scene/syntax_tree.hpp"

#include <string>
#include <string_view>

namespace packtrace::reader {

/// The finite number that `word` spells, the same in every locale. Throws SceneError at the
/// word; `field` is the value it is part of.
[[nodiscard]] double to_number(const Field& field, const Word& word);

/// As text for a message: the shortest that reads back as the same number.
[[nodiscard]] std::string to_text(double number);

}  // namespace packtrace::reader
