// The one place that compiles stb_image.
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "image/png.hpp"

#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace packtrace {
namespace {

int length_of(std::span<const std::uint8_t> file)
{
    if (file.size() > std::numeric_limits<int>::max())
        throw ImageError("the file is too large");
    return static_cast<int>(file.size());
}

// Runs one of stb's loaders, which share their parameters; `full` is the largest sample.
template <class Sample>
Image<float> decode(Sample* (*load)(const stbi_uc*, int, int*, int*, int*, int),
                    std::span<const std::uint8_t> file, float full)
{
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<Sample, void (*)(void*)> samples(
        load(file.data(), length_of(file), &width, &height, &channels, STBI_rgb), stbi_image_free);
    if (!samples)
        throw ImageError(std::string("damaged PNG: ") + stbi_failure_reason());
    Image<float> image(width, height);
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        image.rgb[i] = static_cast<float>(samples.get()[i]) / full;
    return image;
}

}  // namespace

Image<float> decode_png(std::span<const std::uint8_t> file)
{
    if (file.size() < 4 || file[0] != 0x89 || file[1] != 'P' || file[2] != 'N' || file[3] != 'G')
        throw ImageError("not a PNG file");
    if (stbi_is_16_bit_from_memory(file.data(), length_of(file)))
        return decode(stbi_load_16_from_memory, file, 65535.0f);
    return decode(stbi_load_from_memory, file, 255.0f);
}

}  // namespace packtrace
