#include "image/formats.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

namespace packtrace {
namespace {

constexpr std::size_t longest_header = 64;

struct Header {
    int channels = 3;
    int width = 0;
    int height = 0;
    float scale = -1.0f;     // the sign is the byte order, negative for little endian
    std::size_t raster = 0;  // offset of the first sample
};

// Swaps the bytes of a word if `order` is not the order of this machine.
std::uint32_t ordered(std::uint32_t word, std::endian order)
{
    if (order == std::endian::native)
        return word;
    return word << 24 | (word & 0xff00u) << 8 | (word >> 8 & 0xff00u) | word >> 24;
}

float load(const std::uint8_t* bytes, std::endian order)
{
    std::uint32_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    return std::bit_cast<float>(ordered(word, order));
}

void store(float value, std::uint8_t* bytes)
{
    const std::uint32_t word = ordered(std::bit_cast<std::uint32_t>(value), std::endian::little);
    std::memcpy(bytes, &word, sizeof word);
}

Header read_header(std::span<const std::uint8_t> file)
{
    const std::size_t length = std::min(file.size(), longest_header);
    std::istringstream text(std::string(reinterpret_cast<const char*>(file.data()), length));
    text.imbue(std::locale::classic());
    std::string magic;
    Header header;
    if (!(text >> magic) || (magic != "PF" && magic != "Pf"))
        throw ImageError("not a PFM file: it does not start with PF or Pf");
    header.channels = magic == "PF" ? 3 : 1;
    if (!(text >> header.width >> header.height) || header.width < 1 || header.height < 1)
        throw ImageError("bad PFM header: width and height must be positive whole numbers");
    if (!(text >> header.scale) || header.scale == 0.0f || !std::isfinite(header.scale))
        throw ImageError("bad PFM header: the scale must be a number other than 0");
    // One character of white space separates the header from the raster.
    if (text.get() == std::istringstream::traits_type::eof())
        throw ImageError("bad PFM header: it does not end");
    header.raster = static_cast<std::size_t>(text.tellg());
    return header;
}

void check_length(const Header& header, std::size_t size)
{
    // Fits in 64 bits for any two ints; the product with the size of a sample might not.
    const std::size_t samples = static_cast<std::size_t>(header.width) *
                                static_cast<std::size_t>(header.height) *
                                static_cast<std::size_t>(header.channels);
    const std::size_t raster = size - header.raster;
    if (raster % sizeof(float) != 0 || raster / sizeof(float) != samples)
        throw ImageError("the raster has " + std::to_string(raster) + " bytes where a picture of " +
                         std::to_string(header.width) + " x " + std::to_string(header.height) +
                         " needs " + std::to_string(samples) + " floats of 4 bytes");
}

}  // namespace

std::string pfm_header(int width, int height)
{
    return "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
}

template <class Real>
void encode_pfm_values(std::span<const Real> values, std::uint8_t* to)
{
    for (const Real value : values) {
        store(static_cast<float>(value), to);
        to += sizeof(float);
    }
}

template void encode_pfm_values(std::span<const float>, std::uint8_t*);
template void encode_pfm_values(std::span<const double>, std::uint8_t*);
template void encode_pfm_values(std::span<const long double>, std::uint8_t*);

template <class Real>
Bytes encode_pfm(const Image<Real>& image)
{
    const std::string header = pfm_header(image.width, image.height);
    Bytes file(header.begin(), header.end());
    file.resize(header.size() + image.rgb.size() * sizeof(float));
    const std::size_t row = 3 * static_cast<std::size_t>(image.width);
    std::uint8_t* to = file.data() + header.size();
    for (int y = image.height - 1; y >= 0; --y, to += row * sizeof(float))
        encode_pfm_values(std::span<const Real>(image.pixel(0, y), row), to);
    return file;
}

template Bytes encode_pfm(const Image<float>&);
template Bytes encode_pfm(const Image<double>&);
template Bytes encode_pfm(const Image<long double>&);

Image<float> decode_pfm(std::span<const std::uint8_t> file)
{
    const Header header = read_header(file);
    check_length(header, file.size());
    const std::endian order = header.scale < 0.0f ? std::endian::little : std::endian::big;
    const float unit = std::abs(header.scale);
    Image<float> image(header.width, header.height);
    const std::uint8_t* from = file.data() + header.raster;
    for (int y = image.height - 1; y >= 0; --y) {
        float* row = image.pixel(0, y);
        for (int i = 0; i < 3 * image.width; ++i) {
            row[i] = load(from, order) * unit;
            // A grey sample is the value of all three channels.
            if (header.channels == 3 || i % 3 == 2)
                from += sizeof(float);
        }
    }
    return image;
}

}  // namespace packtrace
