#include <benchmark/benchmark.h>
#include <libdeflate.h>

#include <cstdlib>

#include "image/bytes.hpp"
#include "image/quantise.hpp"
#include "png_picture.hpp"

namespace {

// What stb calls to compress; the result belongs to it.
unsigned char* compress(unsigned char* data, int size, int* out_size, int level)
{
    libdeflate_compressor* compressor = libdeflate_alloc_compressor(level);
    const auto length = static_cast<std::size_t>(size);
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor, length);
    auto* out = static_cast<unsigned char*>(std::malloc(bound));
    *out_size = static_cast<int>(libdeflate_zlib_compress(compressor, data, length, out, bound));
    libdeflate_free_compressor(compressor);
    return out;
}

}  // namespace

#define STBIW_ZLIB_COMPRESS compress
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace packtrace::bench {

namespace {

// The length of the file; for one thread at a time.
std::size_t encode_png_stb(const Image<float>& image, int filter, int level)
{
    stbi_write_force_png_filter = filter;
    stbi_write_png_compression_level = level;
    Bytes bytes(image.rgb.size());
    quantise<float>(image.rgb, 1.0, bytes.data());
    int length = 0;
    unsigned char* file =
        stbi_write_png_to_mem(bytes.data(), 3 * image.width, image.width, image.height, 3, &length);
    std::free(file);
    return static_cast<std::size_t>(length);
}

// stb_image_write over libdeflate, which the own writer replaces; filter -1 is stb's choice of
// the best for each row.
void encode_png_with_stb(benchmark::State& state)
{
    std::size_t bytes = 0;
    for (auto _ : state)
        bytes = encode_png_stb(picture(), static_cast<int>(state.range(0)),
                               static_cast<int>(state.range(1)));
    count(state, bytes);
}
BENCHMARK(encode_png_with_stb)
    ->ArgNames({"filter", "level"})
    ->ArgsProduct({{-1, 0, 1, 2}, {1, 2}})
    ->Apply(use_wall_and_cpu_time);

}  // namespace
}  // namespace packtrace::bench
