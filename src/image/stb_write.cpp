// The one place that compiles stb_image_write: PNG and Radiance HDR files.
#include <libdeflate.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "image/hdr.hpp"
#include "image/png.hpp"

namespace packtrace {
namespace {

// Row filter 0 and level 1 are the quickest pair whose files stay small; results/png.json has
// the measurement of the others.
constexpr int png_row_filter = 0;
constexpr int deflate_level = 1;

// What stb calls in place of its own deflate; the result belongs to stb, which frees it.
unsigned char* compress_zlib(unsigned char* data, int size, int* out_size, int /*quality*/)
{
    libdeflate_compressor* compressor = libdeflate_alloc_compressor(deflate_level);
    if (!compressor)
        return nullptr;
    const auto length = static_cast<std::size_t>(size);
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor, length);
    auto* out = static_cast<unsigned char*>(std::malloc(bound));
    if (out)
        *out_size =
            static_cast<int>(libdeflate_zlib_compress(compressor, data, length, out, bound));
    libdeflate_free_compressor(compressor);
    return out;
}

unsigned int crc_of(unsigned char* data, int size)
{
    return libdeflate_crc32(0, data, static_cast<std::size_t>(size));
}

}  // namespace
}  // namespace packtrace

#define STBIW_ZLIB_COMPRESS packtrace::compress_zlib
#define STBIW_CRC32 packtrace::crc_of
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

// stb counts bytes in int.
void check_png_size(int width, int height)
{
    const double bytes = (3.0 * width + 1.0) * height;
    if (bytes > std::numeric_limits<int>::max() / 2)
        throw ImageError("too large for a PNG; use .pfm or .hdr");
}

// The format keeps exponents up to 2^127; both comparisons make NaN 0.
float clamp_to_rgbe(float value)
{
    constexpr float largest = 0x1.fffffep126f;
    const float positive = value > 0.0f ? value : 0.0f;
    return positive < largest ? positive : largest;
}

}  // namespace

Bytes encode_png(const Bytes& rgb, int width, int height)
{
    check_png_size(width, height);
    // stb takes the filter from a global variable; set once, so that threads may encode.
    static const int filter = stbi_write_force_png_filter = png_row_filter;
    static_cast<void>(filter);
    Bytes file;
    if (!stbi_write_png_to_func(append, &file, width, height, 3, rgb.data(), 3 * width))
        throw ImageError("out of memory while encoding the PNG");
    return file;
}

Bytes encode_hdr(const Image<float>& image)
{
    std::vector<float> values(image.rgb.size());
    std::transform(image.rgb.begin(), image.rgb.end(), values.begin(), clamp_to_rgbe);
    Bytes file;
    stbi_write_hdr_to_func(append, &file, image.width, image.height, 3, values.data());
    return file;
}

}  // namespace packtrace
