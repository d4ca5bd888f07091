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

// The formats of picture files: each one's encoder and decoder, whole or a row at a time.
namespace packtrace {

enum class ImageFormat { png, pfm, hdr };

/// The format a picture file's extension stands for, in either case, if any.
[[nodiscard]] std::optional<ImageFormat> find_image_format(const std::filesystem::path& file);

/// The same. Throws ImageError that lists the known ones.
[[nodiscard]] ImageFormat image_format(const std::filesystem::path& file);

/// Runs `use`; what goes wrong becomes an ImageError that names the file.
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
    /// Bytes of samples: more of them are compressed row by row, in little memory, into a larger
    /// file.
    std::size_t largest_whole = std::size_t{1} << 27;
};

/// An 8-bit RGB PNG file. Throws std::invalid_argument for a gamma that is not positive.
template <class Real>
[[nodiscard]] Bytes encode_png(const Image<Real>& image, const PngSettings& settings = {});

/// The file of samples that are rounded already, 3 bytes a pixel, compressed as a whole.
[[nodiscard]] Bytes encode_png_samples(const Bytes& samples, int width, int height);

/// The recipe in a PNG file; empty for none, and where the file is damaged.
[[nodiscard]] std::string png_recipe(std::span<const std::uint8_t> file);

/// The picture in a PNG file; alpha is dropped, grey spread. Throws ImageError without a name.
[[nodiscard]] Image<float> decode_png(std::span<const std::uint8_t> file);

/// An 8-bit RGB PNG file made by libpng row by row. It holds one row at a time.
class PngRows {
public:
    /// Takes the file's bytes as they come, in order. What it throws comes out of the call that
    /// made them.
    using Take = std::function<void(std::span<const std::uint8_t>)>;

    PngRows(int width, int height, Take take);
    ~PngRows();
    PngRows(const PngRows&) = delete;
    PngRows& operator=(const PngRows&) = delete;

    /// The next row, 3 bytes a pixel.
    void write(const std::uint8_t* row);
    /// After the last row.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Gives row `y` of a picture as 3 bytes a pixel.
using GiveRow = std::function<void(int y, std::uint8_t* row)>;

/// The file in memory.
[[nodiscard]] Bytes encode_png_rows(int width, int height, const GiveRow& give_row);

// PFM

/// A Portable Float Map: `PF`, size and scale -1 (little endian), then rows from the bottom.
template <class Real>
[[nodiscard]] Bytes encode_pfm(const Image<Real>& image);

/// What stands before the rows.
[[nodiscard]] std::string pfm_header(int width, int height);

/// The bytes of these values, four each, into `to`.
template <class Real>
void encode_pfm_values(std::span<const Real> values, std::uint8_t* to);

/// The picture in a PFM file of either byte order, colour or grey, multiplied by the size of
/// its scale. The raster must fill the file. Throws ImageError without a file's name.
[[nodiscard]] Image<float> decode_pfm(std::span<const std::uint8_t> file);

// Radiance HDR

/// A Radiance RGBE file. Negative values and NaN become 0, values from 2^127 up the largest
/// below it: the format has no others.
[[nodiscard]] Bytes encode_hdr(const Image<float>& image);

/// What stands before the rows.
[[nodiscard]] std::string hdr_header(int width, int height);

/// Appends a row of red, green and blue to the file.
void append_hdr_row(Bytes& file, std::span<const float> row);

/// The picture in a Radiance file. Throws ImageError without a file's name.
[[nodiscard]] Image<float> decode_hdr(std::span<const std::uint8_t> file);

}  // namespace packtrace
