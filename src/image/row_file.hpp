#pragma once

#include "image/formats.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace packtrace {

/// How rows of a picture are kept until they are written: a byte a value for PNG, a float for the
/// other formats. Pictures of one format and gamma that have the same samples are the same files.
class RowSamples {
public:
    /// Throws ImageError for a file whose extension says no format.
    RowSamples(const std::filesystem::path& file, int width, double gamma);

    [[nodiscard]] ImageFormat format() const
    {
        return format_;
    }
    [[nodiscard]] std::size_t row_bytes() const
    {
        return values_ * (format_ == ImageFormat::png ? 1 : sizeof(float));
    }
    /// The samples of whole rows, into `to`. `Real` is float, double or long double.
    template <class Real>
    void encode(std::span<const Real> rows, std::uint8_t* to) const;

private:
    ImageFormat format_;
    std::size_t values_;  ///< of a row
    double gamma_;
};

/// A picture file written some rows at a time. It has the bytes that write_image() gives the whole
/// picture, appears complete or not at all, and takes little memory however large it is. Everything
/// but the destructor throws ImageError.
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

    /// Adjoining rows, from their uppermost, as RowSamples made them. Calls go through the picture
    /// from the top, or from below where begins_below().
    void write(std::span<const std::uint8_t> samples);
    /// After the last rows.
    void commit();

    struct Encoder;

private:
    std::filesystem::path file_;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace packtrace
