// Writes PNG with stb_image_write and libdeflate, with one filter and one level. results/png.json
// has the measurements for the choice.
#include "core/checksum.hpp"
#include "core/text.hpp"
#include "image/bytes.hpp"
#include "image/formats.hpp"

#include <libdeflate.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

constexpr int filter_up = 2;
constexpr int deflate_level = 2;

/// stb calls it to compress, and frees the result. Null if memory runs out.
unsigned char* compress(unsigned char* data, int size, int* compressed_size, int /*quality*/)
{
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
        libdeflate_alloc_compressor(deflate_level), libdeflate_free_compressor);
    if (!compressor)
        return nullptr;
    const auto length = static_cast<std::size_t>(size);
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), length);
    auto* const compressed = static_cast<unsigned char*>(std::malloc(bound));
    if (compressed == nullptr)
        return nullptr;
    *compressed_size = static_cast<int>(
        libdeflate_zlib_compress(compressor.get(), data, length, compressed, bound));
    return compressed;
}

}  // namespace

#define STBIW_ZLIB_COMPRESS compress
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace packtrace {
namespace {

// A PNG starts with a signature of 8 bytes and the header chunk of 25. The recipe's chunk follows.
constexpr std::size_t recipe_at = 8 + 25;
// The keyword of the text chunk, and a zero byte.
constexpr std::string_view recipe_keyword("packtrace recipe\0", 17);

std::string big_endian(std::size_t number)
{
    std::string bytes;
    for (const int shift : {24, 16, 8, 0})
        bytes += static_cast<char>(number >> shift & 0xffu);
    return bytes;
}

void insert_recipe(Bytes& file, std::string_view recipe)
{
    const std::string typed = std::string("tEXt").append(recipe_keyword).append(recipe);
    const std::string chunk =
        big_endian(typed.size() - 4) + typed + big_endian(checksum(bytes_of(typed)));
    file.insert(file.begin() + recipe_at, chunk.begin(), chunk.end());
}

std::size_t number_at(std::span<const std::uint8_t> file, std::size_t at)
{
    std::size_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
        number = number << 8 | file[at + i];
    return number;
}

/// Whether a PNG file has all its chunks, with correct checksums.
bool is_whole(std::span<const std::uint8_t> file)
{
    constexpr std::size_t around = 12;  // length, type and checksum
    for (std::size_t at = 8; at + around <= file.size();) {
        const std::size_t length = number_at(file, at);
        if (length > file.size() - at - around)
            return false;
        const std::size_t end = at + around + length;
        if (checksum(file.subspan(at + 4, length + 4)) != number_at(file, end - 4))
            return false;
        if (std::string_view(reinterpret_cast<const char*>(file.data()) + at + 4, 4) == "IEND")
            return end == file.size();
        at = end;
    }
    return false;
}

}  // namespace

Bytes encode_png_samples(const Bytes& samples, int width, int height)
{
    // stb's setting is a global variable. The static makes one thread write it, once.
    [[maybe_unused]] static const int filter = stbi_write_force_png_filter = filter_up;
    int length = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> file(
        stbi_write_png_to_mem(samples.data(), 3 * width, width, height, 3, &length), std::free);
    if (!file)
        throw std::bad_alloc();
    return Bytes(file.get(), file.get() + length);
}

template <class Real>
Bytes encode_png(const Image<Real>& image, const PngSettings& settings)
{
    if (!(settings.gamma > 0.0) || std::isinf(settings.gamma))
        throw std::invalid_argument(
            "gamma is " + brief(settings.gamma, 6) +
            "; give a positive number, such as 2.2, or 1 for linear values");
    const auto round = [&](int y, int rows, std::uint8_t* to) {
        const std::size_t count =
            3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(rows);
        quantise(std::span(image.pixel(0, y), count), settings.gamma, to);
    };
    Bytes file;
    if (image.rgb.size() > settings.largest_whole) {
        file = encode_png_rows(image.width, image.height,
                               [&](int y, std::uint8_t* row) { round(y, 1, row); });
    } else {
        Bytes samples(image.rgb.size());
        round(0, image.height, samples.data());
        file = encode_png_samples(samples, image.width, image.height);
    }
    if (!settings.recipe.empty())
        insert_recipe(file, settings.recipe);
    return file;
}

template Bytes encode_png(const Image<float>&, const PngSettings&);
template Bytes encode_png(const Image<double>&, const PngSettings&);
template Bytes encode_png(const Image<long double>&, const PngSettings&);

std::string png_recipe(std::span<const std::uint8_t> file)
{
    constexpr std::size_t text_at = recipe_at + 8;
    if (file.size() < text_at || !is_whole(file))
        return {};
    const std::size_t length = number_at(file, recipe_at);
    const std::string_view type(reinterpret_cast<const char*>(file.data()) + recipe_at + 4, 4);
    const std::string_view text(reinterpret_cast<const char*>(file.data()) + text_at, length);
    if (type != "tEXt" || !text.starts_with(recipe_keyword))
        return {};
    return std::string(text.substr(recipe_keyword.size()));
}

}  // namespace packtrace
