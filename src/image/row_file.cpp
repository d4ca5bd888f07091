#include "image/row_file.hpp"

#include "core/atomic_file.hpp"
#include "image/bytes.hpp"

#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace packtrace {

RowSamples::RowSamples(const std::filesystem::path& file, int width, double gamma)
    : format_(image_format(file)), values_(3 * static_cast<std::size_t>(width)), gamma_(gamma)
{
}

template <class Real>
void RowSamples::encode(std::span<const Real> rows, std::uint8_t* to) const
{
    switch (format_) {
        case ImageFormat::png:
            return quantise(rows, gamma_, to);
        case ImageFormat::pfm:
            return encode_pfm_values(rows, to);
        case ImageFormat::hdr:
            break;
    }
    for (const Real value : rows) {
        const auto single = static_cast<float>(value);
        std::memcpy(to, &single, sizeof single);
        to += sizeof single;
    }
}

template void RowSamples::encode(std::span<const float>, std::uint8_t*) const;
template void RowSamples::encode(std::span<const double>, std::uint8_t*) const;
template void RowSamples::encode(std::span<const long double>, std::uint8_t*) const;

/// Encodes samples into the bytes of the file.
struct RowFile::Encoder {
    explicit Encoder(const std::filesystem::path& file) : output(file)
    {
    }
    virtual ~Encoder() = default;
    virtual void write(std::span<const std::uint8_t> samples) = 0;
    virtual void finish()
    {
    }
    void put(std::span<const std::uint8_t> bytes)
    {
        output.write(std::as_bytes(bytes));
    }

    AtomicFile output;
};

namespace {

class WholePng final : public RowFile::Encoder {
public:
    WholePng(const std::filesystem::path& file, int width, int height)
        : Encoder(file), width_(width), height_(height)
    {
        samples_.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    }
    void write(std::span<const std::uint8_t> samples) override
    {
        samples_.insert(samples_.end(), samples.begin(), samples.end());
    }
    void finish() override
    {
        put(encode_png_samples(samples_, width_, height_));
    }

private:
    int width_;
    int height_;
    Bytes samples_;
};

class LargePng final : public RowFile::Encoder {
public:
    LargePng(const std::filesystem::path& file, int width, int height)
        : Encoder(file),
          row_(3 * static_cast<std::size_t>(width)),
          rows_(width, height, [this](std::span<const std::uint8_t> bytes) { put(bytes); })
    {
    }
    void write(std::span<const std::uint8_t> samples) override
    {
        for (; !samples.empty(); samples = samples.subspan(row_))
            rows_.write(samples.data());
    }
    void finish() override
    {
        rows_.finish();
    }

private:
    std::size_t row_;
    PngRows rows_;
};

class Pfm final : public RowFile::Encoder {
public:
    Pfm(const std::filesystem::path& file, int width, int height)
        : Encoder(file), row_(3 * sizeof(float) * static_cast<std::size_t>(width))
    {
        output.write(pfm_header(width, height));
    }
    void write(std::span<const std::uint8_t> samples) override
    {
        for (; !samples.empty(); samples = samples.first(samples.size() - row_))
            put(samples.last(row_));
    }

private:
    std::size_t row_;
};

class Hdr final : public RowFile::Encoder {
public:
    Hdr(const std::filesystem::path& file, int width, int height)
        : Encoder(file), row_(3 * static_cast<std::size_t>(width))
    {
        output.write(hdr_header(width, height));
    }
    void write(std::span<const std::uint8_t> samples) override
    {
        const std::size_t row_bytes = row_.size() * sizeof(float);
        for (; !samples.empty(); samples = samples.subspan(row_bytes)) {
            std::memcpy(row_.data(), samples.data(), row_bytes);
            bytes_.clear();
            append_hdr_row(bytes_, row_);
            put(bytes_);
        }
    }

private:
    std::vector<float> row_;
    Bytes bytes_;
};

std::unique_ptr<RowFile::Encoder> encoder_for(const std::filesystem::path& file, int width,
                                              int height)
{
    const std::size_t samples =
        3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    switch (image_format(file)) {
        case ImageFormat::png:
            if (samples > PngSettings{}.largest_whole)
                return std::make_unique<LargePng>(file, width, height);
            return std::make_unique<WholePng>(file, width, height);
        case ImageFormat::pfm:
            return std::make_unique<Pfm>(file, width, height);
        case ImageFormat::hdr:
            break;
    }
    return std::make_unique<Hdr>(file, width, height);
}

}  // namespace

RowFile::RowFile(const std::filesystem::path& file, int width, int height) : file_(file)
{
    encoder_ = named(file_, [&] { return encoder_for(file, width, height); });
}

RowFile::~RowFile() = default;

void RowFile::write(std::span<const std::uint8_t> samples)
{
    named(file_, [&] { encoder_->write(samples); });
}

void RowFile::commit()
{
    named(file_, [&] {
        encoder_->finish();
        encoder_->output.commit();
    });
}

}  // namespace packtrace
