// The one place that compiles stb_image: PNG and Radiance HDR files.
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "image/hdr.hpp"
#include "image/png.hpp"

#define STBI_ONLY_PNG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace packtrace {
namespace {

template <class Sample>
struct Decoded {
    struct Free {
        void operator()(Sample* samples) const
        {
            stbi_image_free(samples);
        }
    };
    std::unique_ptr<Sample, Free> samples;
    int width = 0;
    int height = 0;
};

int length_of(std::span<const std::uint8_t> file)
{
    if (file.size() > std::numeric_limits<int>::max())
        throw ImageError("the file is too large");
    return static_cast<int>(file.size());
}

// Runs one of stb's loaders, which share their parameters.
template <class Sample>
Decoded<Sample> decode(Sample* (*load)(const stbi_uc*, int, int*, int*, int*, int),
                       std::span<const std::uint8_t> file)
{
    Decoded<Sample> decoded;
    int channels = 0;
    decoded.samples.reset(
        load(file.data(), length_of(file), &decoded.width, &decoded.height, &channels, STBI_rgb));
    if (!decoded.samples)
        throw ImageError(std::string("damaged picture: ") + stbi_failure_reason());
    return decoded;
}

template <class Sample>
Image<float> to_image(const Decoded<Sample>& decoded, float full)
{
    Image<float> image(decoded.width, decoded.height);
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        image.rgb[i] = static_cast<float>(decoded.samples.get()[i]) / full;
    return image;
}

}  // namespace

Image<float> decode_png(std::span<const std::uint8_t> file)
{
    // stb would take a Radiance file here too, and map its tones.
    if (file.size() < 4 || file[0] != 0x89 || file[1] != 'P' || file[2] != 'N' || file[3] != 'G')
        throw ImageError("not a PNG file");
    if (stbi_is_16_bit_from_memory(file.data(), length_of(file)))
        return to_image(decode(stbi_load_16_from_memory, file), 65535.0f);
    return to_image(decode(stbi_load_from_memory, file), 255.0f);
}

Image<float> decode_hdr(std::span<const std::uint8_t> file)
{
    if (!stbi_is_hdr_from_memory(file.data(), length_of(file)))
        throw ImageError("not a Radiance HDR file");
    return to_image(decode(stbi_loadf_from_memory, file), 1.0f);
}

}  // namespace packtrace
