// Compiled with vectorisation (see src/CMakeLists.txt), which the picture's floats must not
// have: each byte here comes from one value alone.
#include "image/quantise.hpp"

#include <cmath>
#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace packtrace {
namespace {

// Both comparisons are false for NaN, the first of which makes it 0.
std::uint8_t to_byte(float value)
{
    const float scaled = value * 255.0f;
    const float positive = scaled > 0.0f ? scaled : 0.0f;
    const float clamped = positive < 255.0f ? positive : 255.0f;
    return static_cast<std::uint8_t>(static_cast<int>(clamped + 0.5f));
}

void quantise_linear(const float* from, std::uint8_t* to, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i)
        to[i] = to_byte(from[i]);
}

void quantise_gamma(const float* from, std::uint8_t* to, std::size_t count, float exponent)
{
    for (std::size_t i = 0; i < count; ++i)
        to[i] = to_byte(from[i] > 0.0f ? std::pow(from[i], exponent) : 0.0f);
}

}  // namespace

Bytes quantise(const Image<float>& image, double gamma)
{
    if (!(gamma > 0.0) || std::isinf(gamma))
        throw std::invalid_argument("gamma must be positive and finite");
    const auto exponent = static_cast<float>(1.0 / gamma);
    Bytes bytes(image.rgb.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bytes.size(), 1 << 16),
                      [&](const tbb::blocked_range<std::size_t>& part) {
                          const float* from = image.rgb.data() + part.begin();
                          std::uint8_t* to = bytes.data() + part.begin();
                          if (gamma == 1.0)
                              quantise_linear(from, to, part.size());
                          else
                              quantise_gamma(from, to, part.size(), exponent);
                      });
    return bytes;
}

}  // namespace packtrace
