#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace packtrace::reader {

/// A scene file's bytes; no more are read than tell that it is longer than a scene may be.
/// Throws SceneError for a file that can't be read.
[[nodiscard]] std::string load_text(const std::filesystem::path& file);

/// The same of a stream; `name` stands for it in messages.
[[nodiscard]] std::string load_text(std::istream& in, const std::string& name);

}  // namespace packtrace::reader
