#pragma once

#include "core/read_file.hpp"
#include "image/bytes.hpp"
#include <packtrace/image_io.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

// The encoders and decoders of picture files, for whole pictures or one row at a time.
namespace packtrace {

enum class ImageFormat { png, pfm, hdr };

/// The format of a file's extension, in upper or lower case; not set for an unknown extension.
[[nodiscard]] std::optional<ImageFormat> find_image_format(const std::filesystem::path& file);

/// The format of a file's extension. Throws ImageError, which lists the known extensions.
[[nodiscard]] ImageFormat image_format(const std::filesystem::path& file);

/// Runs `use`. Its errors become ImageErrors that name the file.
template <class Use>
auto named(const std::filesystem::path& file, const Use& use)
{
    try {
        return use();
    } catch (const FileError& error) {
        throw ImageError(error.what());
    } catch (const ImageError& error) {
        const std::string what = error.what();
        throw ImageError(what.starts_with(file.string()) ? what : file.string() + ": " + what);
    }
}

// PNG

struct PngSettings {
    double gamma = 1.0;       ///< as in ImageWriteOptions
    std::string recipe = {};  ///< as in ImageWriteOptions
    /// The largest picture that is compressed as a whole, in bytes of samples. Larger ones are
    /// compressed row by row, which takes little memory but gives a larger file.
    std::size_t largest_whole = std::size_t{1} << 27;
};

/// An 8-bit RGB PNG file. Throws std::invalid_argument for a gamma that is not positive.
template <class Real>
[[nodiscard]] Bytes encode_png(const Image<Real>& image, const PngSettings& settings = {});

/// The PNG file of samples that are already rounded, 3 bytes per pixel, compressed as a whole.
[[nodiscard]] Bytes encode_png_samples(const Bytes& samples, int width, int height);

/// The recipe in a PNG file; empty if there is none, or if the file is damaged.
[[nodiscard]] std::string png_recipe(std::span<const std::uint8_t> file);

/// The picture in a PNG file. Alpha is ignored, and grey is copied to all channels. Throws
/// ImageError without a file's name.
[[nodiscard]] Image<float> decode_png(std::span<const std::uint8_t> file);

/// Writes an 8-bit RGB PNG file with libpng, row by row. It holds one row at a time.
class PngRows {
public:
    /// Receives the bytes of the file, in order. Its exceptions leave the call that made the bytes.
    using Take = std::function<void(std::span<const std::uint8_t>)>;

    PngRows(int width, int height, Take take);
    ~PngRows();
    PngRows(const PngRows&) = delete;
    PngRows& operator=(const PngRows&) = delete;

    /// Writes the next row, 3 bytes per pixel.
    void write(const std::uint8_t* row);
    /// Call it after the last row.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Writes row `y` of a picture to `row`, 3 bytes per pixel.
using GiveRow = std::function<void(int y, std::uint8_t* row)>;

/// A PNG file in memory, made with PngRows.
[[nodiscard]] Bytes encode_png_rows(int width, int height, const GiveRow& give_row);

// PFM

/// A Portable Float Map: `PF`, size and scale -1 (little endian), then rows from the bottom.
template <class Real>
[[nodiscard]] Bytes encode_pfm(const Image<Real>& image);

/// The part of the file before the rows.
[[nodiscard]] std::string pfm_header(int width, int height);

/// Writes the bytes of the values to `to`, four per value.
template <class Real>
void encode_pfm_values(std::span<const Real> values, std::uint8_t* to);

/// The picture in a PFM file of either byte order, in colour or grey, multiplied by the magnitude
/// of its scale. The raster must extend to the end of the file. Throws ImageError without a file's
/// name.
[[nodiscard]] Image<float> decode_pfm(std::span<const std::uint8_t> file);

// Radiance HDR

/// A Radiance RGBE file. The format has only values from 0 to below 2^127: negative values and NaN
/// become 0, larger values the largest one.
[[nodiscard]] Bytes encode_hdr(const Image<float>& image);

/// The part of the file before the rows.
[[nodiscard]] std::string hdr_header(int width, int height);

/// Appends a row of r, g, b values to the file.
void append_hdr_row(Bytes& file, std::span<const float> row);

/// The picture in a Radiance file, divided by the product of its EXPOSURE lines. Throws ImageError
/// without a file's name.
[[nodiscard]] Image<float> decode_hdr(std::span<const std::uint8_t> file);

}  // namespace packtrace
