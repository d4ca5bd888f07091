#pragma once

#include <filesystem>
#include <string>

#include "core/file_error.hpp"

namespace packtrace {

/// The bytes of a file. Throws FileError.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace packtrace
