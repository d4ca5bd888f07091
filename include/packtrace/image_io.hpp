#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace packtrace {

/// A picture file cannot be read or written. `what()` is one line that names the file.
struct PACKTRACE_API ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct ImageWriteOptions {
    /// PNG only: values are raised to 1 / gamma before rounding; 1 writes linear values. Other
    /// formats accept 1 only.
    double gamma = 1.0;
    /// How the picture was made: at most 2000 printable ASCII characters; empty for none. A PNG
    /// stores it in a text chunk. For other formats it is in a second file, whose name is that of
    /// the picture with `.recipe` appended.
    std::string recipe = {};
};

/// Writes `image` in the format of the file's extension: `.png` (8 bits, clamped and rounded),
/// `.pfm` (32-bit float) or `.hdr` (Radiance RGBE). Values are rounded once, from `Real` (float,
/// double or long double) to the values of the file; a Radiance file is made from floats. Writes to
/// a temporary name beside `file` and renames the complete file. Throws ImageError if the file
/// cannot be written. Throws std::invalid_argument for a gamma that is not positive and finite or
/// that the format does not support, for an invalid recipe, and for an `image` whose `rgb` does not
/// have three values per pixel.
template <class Real>
PACKTRACE_API void write_image(const std::filesystem::path& file, const Image<Real>& image,
                               const ImageWriteOptions& options = {});

/// Returns the recipe of a picture. Empty if there is no recipe, if the picture is not the one that
/// the recipe was written with, or if there is no picture. Throws ImageError for an unknown
/// extension.
[[nodiscard]] PACKTRACE_API std::string read_recipe(const std::filesystem::path& file);

/// Throws ImageError if `write_image` would fail for every picture: the extension is unknown, or
/// the folder is missing or not writable. Leaves no file behind.
PACKTRACE_API void check_image_writable(const std::filesystem::path& file);

/// Reads a `.png`, `.pfm` or `.hdr` picture. 8-bit values v become v / 255. Throws ImageError if
/// the file cannot be read.
[[nodiscard]] PACKTRACE_API Image<float> read_image(const std::filesystem::path& file);

}  // namespace packtrace
