#pragma once

#include <string>
#include <string_view>

namespace packtrace::reader {

/// `text` fit for one line of a terminal: control characters and bytes that are not UTF-8
/// become \xNN.
[[nodiscard]] std::string escape(std::string_view text);

/// `text` in single quotes for a message: escaped, and cut after a few dozen bytes.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace packtrace::reader
