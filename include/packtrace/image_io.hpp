#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace packtrace {

/// A picture file that can't be read or written; `what()` is one line that names the file.
struct PACKTRACE_API ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct ImageWriteOptions {
    /// PNG only: values are raised to 1 / gamma before rounding; 1 writes them linear. Other
    /// formats take 1 alone.
    double gamma = 1.0;
    /// At most 2000 printable ASCII characters that say what made the picture; empty for none. A
    /// PNG keeps it in a text chunk, other formats in a file beside the picture: its name with
    /// `.recipe` added.
    std::string recipe = {};
};

/// Writes `image` by the file's extension: `.png` (8 bits, clamped and rounded), `.pfm`
/// (32-bit float) or `.hdr` (Radiance RGBE). Values are rounded once, from `Real` (float, double or
/// long double) to what the file holds; a Radiance file is made from floats. Writes to a temporary
/// name beside `file` and renames it when complete. Throws ImageError, and std::invalid_argument
/// for a gamma that is not positive and finite or that the format has not, a recipe that is no such
/// text, and an `image` whose `rgb` has not three values a pixel.
template <class Real>
PACKTRACE_API void write_image(const std::filesystem::path& file, const Image<Real>& image,
                               const ImageWriteOptions& options = {});

/// The recipe that a picture was written with; empty when there is none, when the picture is not
/// the one that was written with it, or when there is no picture. Throws ImageError where the
/// extension is unknown.
[[nodiscard]] PACKTRACE_API std::string read_recipe(const std::filesystem::path& file);

/// Throws the ImageError that `write_image` would throw for `file` whatever the picture: its
/// extension is unknown, its folder is missing or can't be written to. Leaves nothing behind.
PACKTRACE_API void check_image_writable(const std::filesystem::path& file);

/// Reads a `.png`, `.pfm` or `.hdr` picture; 8-bit values become v / 255. Throws ImageError.
[[nodiscard]] PACKTRACE_API Image<float> read_image(const std::filesystem::path& file);

}  // namespace packtrace
