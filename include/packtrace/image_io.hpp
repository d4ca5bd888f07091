#pragma once

#include <filesystem>
#include <stdexcept>

#include <packtrace/image.hpp>

namespace packtrace {

/// A picture file that can't be read or written; `what()` is one line that names the file.
struct ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct ImageWriteOptions {
    /// PNG only: values are raised to 1 / gamma before rounding; 1 writes them linear.
    double gamma = 1.0;
};

/// Writes `image` by the file's extension: `.png` (8 bits, clamped and rounded), `.pfm`
/// (32-bit float) or `.hdr` (Radiance RGBE). Writes to a temporary name beside `file` and
/// renames it when complete. Throws ImageError.
void write_image(const std::filesystem::path& file, const Image<float>& image,
                 const ImageWriteOptions& options = {});

/// Throws the ImageError that `write_image` would throw for `file` whatever the picture: its
/// extension is unknown, its folder is missing or can't be written to. Leaves nothing behind.
void check_image_writable(const std::filesystem::path& file);

/// Reads a `.png`, `.pfm` or `.hdr` picture; 8-bit values become v / 255. Throws ImageError.
[[nodiscard]] Image<float> read_image(const std::filesystem::path& file);

}  // namespace packtrace
