#pragma once

#include "image/formats.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace packtrace {

/// The samples of rows that are kept until they are written: one byte per value for PNG, one float
/// for other formats. Equal samples, format and gamma give equal files.
class RowSamples {
public:
    /// Throws ImageError for an unknown extension.
    RowSamples(const std::filesystem::path& file, int width, double gamma);

    [[nodiscard]] ImageFormat format() const
    {
        return format_;
    }
    [[nodiscard]] std::size_t row_bytes() const
    {
        return values_ * (format_ == ImageFormat::png ? 1 : sizeof(float));
    }
    /// Writes the samples of whole rows to `to`. `Real` is float, double or long double.
    template <class Real>
    void encode(std::span<const Real> rows, std::uint8_t* to) const;

private:
    ImageFormat format_;
    std::size_t values_;  ///< per row
    double gamma_;
};

/// Writes a picture file some rows at a time. The file equals that of write_image(), byte for byte,
/// and appears complete or not at all. The memory does not depend on the number of rows. All
/// members except the destructor throw ImageError.
class RowFile {
public:
    /// `file` may have any extension that write_image() knows.
    RowFile(const std::filesystem::path& file, int width, int height);
    ~RowFile();
    RowFile(const RowFile&) = delete;
    RowFile& operator=(const RowFile&) = delete;

    /// Whether the file begins with the picture's last row.
    [[nodiscard]] static bool begins_below(ImageFormat format)
    {
        return format == ImageFormat::pfm;
    }

    /// Writes adjacent rows, made by RowSamples, uppermost row first. Successive calls go down the
    /// picture; up, if begins_below().
    void write(std::span<const std::uint8_t> samples);
    /// Call it after the last rows.
    void commit();

    struct Encoder;

private:
    std::filesystem::path file_;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace packtrace
