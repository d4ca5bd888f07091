// The one place that compiles stb_image_write.
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

Bytes encode_hdr(const Image<float>& image)
{
    std::vector<float> values(image.rgb.size());
    std::transform(image.rgb.begin(), image.rgb.end(), values.begin(), clamp_to_rgbe);
    Bytes file;
    stbi_write_hdr_to_func(append, &file, image.width, image.height, 3, values.data());
    return file;
}

}  // namespace packtrace
