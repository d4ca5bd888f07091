#pragma once

#include <filesystem>

#include <packtrace/image_io.hpp>

namespace packtrace {

enum class ImageFormat { png, pfm, hdr };

/// The format a picture file's extension stands for, in either case. Throws ImageError that
/// lists the known ones.
[[nodiscard]] ImageFormat image_format(const std::filesystem::path& file);

}  // namespace packtrace
