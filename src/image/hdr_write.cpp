// Radiance pictures: stb_image_write, a row at a time.
#include <algorithm>

#include "image/hdr.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace packtrace {
namespace {

void append(void* file, void* data, int size)
{
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    auto& to = *static_cast<Bytes*>(file);
    to.insert(to.end(), bytes, bytes + size);
}

// The format keeps exponents up to 2^127; both comparisons make NaN 0.
float clamp_to_rgbe(float value)
{
    constexpr float largest = 0x1.fffffep126f;
    const float positive = value > 0.0f ? value : 0.0f;
    return positive < largest ? positive : largest;
}

}  // namespace

std::string hdr_header(int width, int height)
{
    return "#?RADIANCE\n# Written by stb_image_write.h\nFORMAT=32-bit_rle_rgbe\n"
           "EXPOSURE=          1.0000000000000\n\n-Y " +
           std::to_string(height) + " +X " + std::to_string(width) + "\n";
}

void append_hdr_row(Bytes& file, std::span<const float> row)
{
    std::vector<float> values(row.size());
    std::transform(row.begin(), row.end(), values.begin(), clamp_to_rgbe);
    const auto width = static_cast<int>(row.size() / 3);
    std::vector<unsigned char> scratch(4 * row.size() / 3);
    stbi__write_context context{};
    stbi__start_write_callbacks(&context, append, &file);
    stbiw__write_hdr_scanline(&context, width, 3, scratch.data(), values.data());
    stbiw__write_flush(&context);
}

Bytes encode_hdr(const Image<float>& image)
{
    const std::string header = hdr_header(image.width, image.height);
    Bytes file(header.begin(), header.end());
    const std::size_t row = 3 * static_cast<std::size_t>(image.width);
    for (int y = 0; y < image.height; ++y)
        append_hdr_row(file, {image.pixel(0, y), row});
    return file;
}

}  // namespace packtrace
